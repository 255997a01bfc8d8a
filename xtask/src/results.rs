//! `cargo xtask results [NAME…]`: the tables of `validation/results`. Without names it lists each table with the commit it was
//! made from, and whether the code that it speaks of has changed since. With names it makes those tables again, by the
//! commands that stand in them, and notes commit and machine below.
//!
//! Words in capitals in a command, such as CORPUS, are folders that the caller has: they are taken from environment variables
//! of these names.

use crate::command::{compiler, output, succeed};
use std::collections::BTreeSet;
use std::process::Command;

const FOLDER: &str = "validation/results";

/// How the line begins that says where a table comes from.
const MADE: &str = "Made from commit ";

/// Tables that speak of other code than [`ENGINE`], with that code.
const SPEAK_OF: [(&str, &[&str]); 35] = [
    ("bus_time", &["src/protocol", "src/wire", "src/hardware"]),
    ("controllers", &["src/physics", "mjcf", "src/robot", "src/env", "src/control", "assets"]),
    ("deformable_tasks", &["src/physics", "mjcf", "assets"]),
    ("draws", &["src/random"]),
    ("encoders", &["src/encoders"]),
    ("environments", &["src/physics", "mjcf", "src/robot", "src/env"]),
    ("environments_speed", &["src/physics", "mjcf", "src/robot", "src/env"]),
    ("environments_visual", &["src/physics", "mjcf", "src/robot", "src/env", "src/render"]),
    ("gymnasium", &["src/physics", "mjcf", "src/env"]),
    ("identify", &["src/physics", "mjcf", "src/identify"]),
    ("items", &["src/physics", "mjcf", "src/render/scene"]),
    ("laws", &["src/physics", "mjcf", "src/robot", "src/env", "assets"]),
    ("learners", &["src/physics", "src/env", "python"]),
    ("learning_speed", &["src/physics", "src/env", "src/agents", "python"]),
    ("pictures", &["src/physics", "mjcf", "src/render"]),
    ("pictures_gpu", &["src/physics", "mjcf", "src/render", "src/render_gpu"]),
    ("planning", &["src/physics", "src/control", "assets"]),
    ("ppo", &["src/physics", "mjcf", "src/env", "python"]),
    ("python_ray", &["src/env", "python"]),
    ("python_speed", &["src/physics", "src/env", "python"]),
    ("quirks", &["src/robot", "src/env/suite"]),
    ("rapier", &["src/physics", "mjcf", "src/rapier", "src/env", "src/teleop"]),
    ("robot_configs", &["src/physics", "src/env", "src/robot", "src/wire", "src/hardware"]),
    ("robots", &["assets"]),
    ("robots_speed", &["src/physics", "mjcf", "src/env", "assets"]),
    ("shipped", &["src/physics", "mjcf", "src/env", "src/agents", "assets"]),
    ("standin", &["src/physics", "mjcf", "python"]),
    ("standin_dm_control", &["src/physics", "mjcf", "python"]),
    ("standin_myosuite", &["src/physics", "mjcf", "python"]),
    ("standin_suite", &["src/physics", "mjcf", "python"]),
    ("standin_sysid", &["src/physics", "mjcf", "python"]),
    ("standin_tests", &["src/physics", "mjcf", "python"]),
    ("targets", &["src/physics", "mjcf", "src/env", "src/agents"]),
    ("task_scenes", &["src/physics", "mjcf", "assets"]),
    ("web", &["src/physics", "mjcf", "src/render", "src/viewer", "web"]),
];
/// What most tables speak of.
const ENGINE: &[&str] = &["src/physics", "mjcf"];

/// Lists all tables, or makes those named again.
pub fn run(names: &[&str]) -> Result<(), String> {
    let all = tables()?;
    if let Some(unknown) = names.iter().find(|name| !all.iter().any(|table| table == *name)) {
        return Err(format!("there is no table {unknown}; there are {}", all.join(", ")));
    }
    if names.is_empty() {
        return all.iter().try_for_each(|name| list(name));
    }
    names.iter().try_for_each(|name| make(name))
}

/// The names of all tables.
fn tables() -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(FOLDER).map_err(|error| format!("{FOLDER}: {error}"))?;
    let files = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<_> = files.filter_map(|file| file.strip_suffix(".md").map(str::to_owned)).collect();
    names.sort();
    Ok(names)
}

fn path(name: &str) -> String {
    format!("{FOLDER}/{name}.md")
}

fn read(name: &str) -> Result<String, String> {
    std::fs::read_to_string(path(name)).map_err(|error| format!("{}: {error}", path(name)))
}

/// One line: the commit, and whether the table is older than the code.
fn list(name: &str) -> Result<(), String> {
    let text = read(name)?;
    let noted = text.lines().find_map(|line| line.strip_prefix(MADE)?.split_whitespace().next());
    let commit = match noted {
        Some(commit) => commit.trim_end_matches([',', '.']).to_owned(),
        None => git(&["log", "-1", "--format=%h", "--", &path(name)])?,
    };
    let how = if noted.is_some() { "made from" } else { "last written in" };
    let sources = SPEAK_OF.iter().find(|(table, _)| *table == name).map_or(ENGINE, |(_, sources)| sources);
    let unchanged = git(&[&["diff", "--quiet", &commit, "--"], sources].concat()).is_ok();
    let age = if unchanged { "as new as the code" } else { "older than the code that it speaks of" };
    println!("{name:20} {how} {commit:12} {age}");
    Ok(())
}

/// Runs the commands that write a table, and notes where it comes from.
fn make(name: &str) -> Result<(), String> {
    let commands = commands(&read(name)?, &path(name));
    if commands.is_empty() {
        return Err(format!("{} holds no command that writes it: see its text", path(name)));
    }
    for command in commands {
        let missing: Vec<_> =
            placeholders(&command).into_iter().filter(|word| std::env::var_os(word).is_none()).collect();
        if !missing.is_empty() {
            return Err(format!("set {} to what {name}.md says of it: {command}", missing.join(", ")));
        }
        let filled = placeholders(&command).iter().fold(command.clone(), |text, word| {
            let value = std::env::var(word).unwrap_or_default();
            text.replace(word.as_str(), &value)
        });
        println!("-- {filled}");
        succeed(Command::new("bash").args(["-euo", "pipefail", "-c", &filled]))?;
    }
    let text = read(name)?;
    let kept: Vec<_> = text.lines().filter(|line| !line.starts_with(MADE)).collect();
    let noted = format!("{}\n\n{}\n", kept.join("\n").trim_end(), provenance()?);
    std::fs::write(path(name), noted).map_err(|error| format!("{}: {error}", path(name)))
}

/// The commands in a text, in blocks or between backquotes, that write `file`.
fn commands(text: &str, file: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut block: Option<String> = None;
    for line in text.lines() {
        match (&mut block, line.trim_start().starts_with("```")) {
            (None, true) => block = Some(String::new()),
            (Some(lines), true) => {
                let joined = lines.replace("\\\n", " ").replace("|\n", "| ");
                found.extend(joined.lines().map(str::to_owned));
                block = None;
            }
            (Some(lines), false) => *lines += &format!("{line}\n"),
            (None, false) => found.extend(line.split('`').skip(1).step_by(2).map(str::to_owned)),
        }
    }
    found.retain(|command| command.contains(file) && command.contains(' '));
    found.iter().map(|command| command.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

/// Words of capitals that stand for a folder or file; not names of variables that the command sets.
fn placeholders(command: &str) -> BTreeSet<String> {
    let words = command.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '='));
    let capital = |word: &&str| word.len() > 3 && word.chars().all(|c| c.is_ascii_uppercase());
    words.flat_map(|word| word.rsplit('=').next()).filter(capital).map(str::to_owned).collect()
}

/// Commit, machine and compiler of this run.
fn provenance() -> Result<String, String> {
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let sources = git(&["status", "--porcelain", "--untracked-files=no", "--", ".", ":!validation/results"])?;
    let changed = if sources.is_empty() { "" } else { " with changes" };
    let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let machine = model.map_or(std::env::consts::ARCH, |(_, model)| model);
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    Ok(format!("{MADE}{commit}{changed}, on {machine}, {cores} cores, {}.", compiler()?))
}

fn git(words: &[&str]) -> Result<String, String> {
    output(Command::new("git").args(words)).map(|(printed, _)| printed.trim().to_owned())
}
