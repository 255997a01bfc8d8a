//! What the command says of itself: help, examples that work, completions, manual pages, version.

mod command;

use command::{ROOT, command, robohive, scratch, text};
use std::fs::File;
use std::path::Path;
use std::process::Stdio;

/// Names of all subcommands, from the main help.
fn subcommands() -> Vec<String> {
    let help = text(&robohive(&["--help"]).stdout);
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let lines = list.lines().take_while(|line| line.starts_with("  "));
    let names: Vec<_> = lines.filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect();
    assert!(names.len() >= 9 && names.contains(&"help".to_owned()), "{names:?}");
    names.into_iter().filter(|name| name != "help").collect()
}

/// The words of all commands and subcommands.
fn commands() -> Vec<Vec<String>> {
    let nested = |name: String| {
        let help = text(&robohive(&[&name, "--help"]).stdout);
        let (_, list) = help.split_once("\nCommands:\n").unwrap_or_default();
        let lines = list.lines().take_while(|line| line.starts_with("  "));
        let inner = lines.filter_map(|line| line.split_whitespace().next()).filter(|&inner| inner != "help");
        let mut words: Vec<_> = inner.map(|inner| vec![name.clone(), inner.to_owned()]).collect();
        words.insert(0, vec![name]);
        words
    };
    let commands: Vec<_> = subcommands().into_iter().flat_map(nested).collect();
    assert!(commands.contains(&vec!["assets".to_owned(), "import".to_owned()]), "{commands:?}");
    commands
}

/// The help of a command.
fn help(words: &[String]) -> String {
    text(&command().args(words).arg("--help").output().unwrap().stdout)
}

/// One example: its words, and the file that it reads as standard input.
struct Example {
    words: Vec<String>,
    input: Option<String>,
}

/// The examples of a help text that run this command; what they pipe to others is left out.
fn examples(help: &str) -> Vec<Example> {
    let (_, section) = help.split_once("\nExamples:\n").expect("a section of examples");
    // A line longer than the help is wide goes on at the same indentation, before an option.
    let section = section.replace("\\\n", " ").replace("\n  --", " --");
    let lines = section.lines().filter_map(|line| line.strip_prefix("  robohive "));
    let example = |line: &str| {
        let end = ["   ", " | ", " > "].iter().filter_map(|mark| line.find(mark)).min();
        let line = &line[..end.unwrap_or(line.len())];
        let (words, input) = line.split_once(" < ").unwrap_or((line, ""));
        let input = (!input.is_empty()).then(|| input.trim().to_owned());
        Example { words: words.split_whitespace().map(str::to_owned).collect(), input }
    };
    lines.map(example).collect()
}

/// Every example works as it stands, in order, in a folder that has the repository's models and references.
#[test]
fn examples_of_every_help_run() {
    let folder = scratch("examples");
    _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for shared in ["assets", "validation"] {
        link(&Path::new(ROOT).join(shared), &folder.join(shared));
    }
    let model = folder.join("simhive/Adroit/hand.xml");
    std::fs::create_dir_all(model.parent().unwrap()).unwrap();
    std::fs::write(model, "<mujoco/>").unwrap();
    let link = "<link name='base'><collision><geometry><sphere radius='1'/></geometry></collision></link>";
    std::fs::write(folder.join("robot.urdf"), format!("<robot name='ball'>{link}</robot>")).unwrap();
    archive(&folder.join("A.npz"), "actions", vec![3, 8]);
    archive(&folder.join("S.npz"), "time", vec![2, 1]);
    for name in commands() {
        let examples = examples(&help(&name));
        assert!(examples.iter().any(|example| example.words.starts_with(&name)), "{name:?}");
        for Example { words, input } in examples {
            let input = input.map_or(Stdio::null(), |path| File::open(folder.join(path)).unwrap().into());
            let mut command = command();
            command
                .args(&words)
                .current_dir(&folder)
                .env("ROBOHIVE_STORE", folder.join("store"))
                .env("MINARI_DATASETS_PATH", folder.join("minari"))
                .env("ROBOHIVE_PAGE", folder.join("no page"))
                .stdin(input);
            let out = command.output().unwrap();
            if words[0] == "web" {
                // The page has not been built, and serving it would not end: tests/web.rs does.
                assert!(text(&out.stderr).contains("cargo xtask web"), "{words:?}");
                continue;
            }
            if words[0] == "view" {
                // Here is neither a build with a window nor a display, and it says so.
                assert!(!out.status.success() && text(&out.stderr).contains("window"), "{words:?}");
                continue;
            }
            if words[0] == "teleop" && !words.contains(&"--print-mapping".to_owned()) {
                // Here is neither a terminal nor a gamepad nor an adb server: tests/teleop.rs has both ends of these.
                let why = text(&out.stderr);
                let says = ["no terminal", "there is none", "adb start-server"];
                assert!(says.iter().any(|says| why.contains(says)), "{words:?}: {why}");
                continue;
            }
            assert!(out.status.success(), "{words:?}: {}{}", text(&out.stdout), text(&out.stderr));
            assert!(!out.stdout.is_empty() || words[0] == "trace", "{words:?} prints nothing");
        }
    }
}

/// An archive of one array of zeros.
fn archive(path: &Path, name: &str, shape: Vec<usize>) {
    let mut archive = dataset::NpzWriter::create(path).unwrap();
    let values = vec![0.0; shape.iter().product()];
    archive.add(name, &dataset::Array::f64(shape, values)).unwrap();
    archive.finish().unwrap();
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) {
    std::os::unix::fs::symlink(from, to).unwrap();
}

#[cfg(windows)]
fn link(from: &Path, to: &Path) {
    std::os::windows::fs::symlink_dir(from, to).unwrap();
}

/// A row of the table in README.md names commands, or the first subcommand and then the others alone.
#[test]
fn the_table_of_commands_names_every_command() {
    let readme = std::fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap();
    for words in commands() {
        let named = ["`", " "].map(|end| format!("`robohive {}{end}", words[0]));
        let row = readme
            .lines()
            .find(|line| line.starts_with("| `robohive ") && named.iter().any(|name| line.contains(name)));
        let row = row.unwrap_or_else(|| panic!("README.md has no row for {words:?}"));
        let named = words.get(1).is_none_or(|inner| {
            [format!("{inner}`"), format!("{} {inner} ", words[0])].iter().any(|form| row.contains(form))
        });
        assert!(named, "{words:?} is not in the row {row}");
    }
}

#[test]
fn help_fits_eighty_columns() {
    for name in commands() {
        let out = command().args(&name).arg("--help").env("COLUMNS", "80").output().unwrap();
        for line in text(&out.stdout).lines().filter(|line| !line.contains("robohive ")) {
            assert!(line.chars().count() <= 80, "{name:?}: {line}");
        }
    }
}

#[test]
fn the_version_names_the_commit_and_mujoco() {
    let version = text(&robohive(&["--version"]).stdout);
    let inside = version
        .strip_prefix(concat!("robohive ", env!("CARGO_PKG_VERSION"), " ("))
        .and_then(|rest| rest.strip_suffix("follows MuJoCo 3.12.0)\n"));
    let commit = inside.unwrap_or_else(|| panic!("{version}"));
    if Path::new(ROOT).join(".git").exists() {
        let commit = commit.strip_prefix("commit ").and_then(|rest| rest.strip_suffix(", ")).unwrap();
        assert!(commit.len() == 10 && commit.bytes().all(|b| b.is_ascii_hexdigit()), "{version}");
    }
}

#[test]
fn completions_know_every_command() {
    for shell in ["bash", "zsh", "fish"] {
        let out = robohive(&["completions", shell]);
        assert!(out.status.success() && out.stderr.is_empty(), "{}", text(&out.stderr));
        let script = text(&out.stdout);
        for name in subcommands() {
            assert!(script.contains(&name), "{shell} does not complete {name}");
        }
        for option in ["keyframe", "forward", "jitter"] {
            assert!(script.contains(option), "{shell} does not complete {option}");
        }
    }
    assert_eq!(robohive(&["completions", "cobol"]).status.code(), Some(2));
}

#[test]
fn every_command_has_a_manual_page_with_its_examples() {
    let folder = scratch("man1");
    _ = std::fs::remove_dir_all(&folder);
    let out = robohive(&["man", "--out", folder.to_str().unwrap()]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    for name in commands() {
        let page = std::fs::read_to_string(folder.join(format!("robohive-{}.1", name.join("-")))).unwrap();
        // Manual pages escape hyphens.
        let page = page.replace("\\-", "-");
        let (_, examples) = page.split_once(".SH EXAMPLES\n").unwrap();
        assert!(
            page.contains(".TH ") && examples.contains(&format!("robohive {}", name.join(" "))),
            "{page}"
        );
    }
    let main = std::fs::read_to_string(folder.join("robohive.1")).unwrap();
    assert_eq!(text(&robohive(&["man"]).stdout), main);
    assert!(main.contains("robohive\\-completions(1)") && main.contains("Exit codes"), "{main}");
}
