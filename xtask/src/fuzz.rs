//! `cargo xtask fuzz [SECONDS] [TARGET…]`: libFuzzer on every target of `fuzz/`, or on those named, one after the other,
//! as a table. `cargo xtask fuzz keep [TARGET…]`: keeps a small set of inputs that reach what all inputs found so far
//! reach, one archive a target. Needs `cargo install cargo-fuzz` and a C++ compiler.

#[path = "../../fuzz/archive.rs"]
mod archive;

use archive::Inputs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// A unit that takes longer \[s\] is a finding.
const HANG: u32 = 1;
/// More memory \[MB\] is a finding.
const MEMORY: u32 = 1024;

/// Seconds for each target where the command line names none.
const SECONDS: u32 = 600;

/// Longest name of a kept input: libFuzzer names inputs by a digest of 40 digits; this many is enough to distinguish them.
const NAME: usize = 12;
/// Kept inputs are at most this long \[bytes\].
const LONGEST_KEPT: &str = "-max_len=1000";

/// Runs each of the targets that the words name, or every one, for the seconds that the first word gives; an error
/// when there is a finding. After the word `keep`, chooses what is kept instead.
pub fn run(words: &[&str]) -> Result<(), String> {
    if let ["keep", ref targets @ ..] = *words {
        return asked(targets)?.iter().try_for_each(|target| keep(target));
    }
    let (seconds, targets) = match words.split_first().map(|(first, rest)| (first.parse(), rest)) {
        Some((Ok(seconds), rest)) => (seconds, rest),
        _ => (SECONDS, words),
    };
    let targets = asked(targets)?;
    cargo_fuzz(&["build", "-s", "none"], Stdio::inherit())?;
    let mut findings = 0;
    println!("| target | executions | seconds | peak memory [MB] | findings |\n|---|---|---|---|---|");
    for target in &targets {
        let row = fuzz(target, seconds)?;
        println!(
            "| {target} | {} | {:.0} | {} | {} |",
            row.executions, row.seconds, row.memory, row.findings
        );
        findings += row.findings;
    }
    match findings {
        0 => Ok(()),
        n => Err(format!("{n} findings in fuzz/artifacts")),
    }
}

/// The targets named, or all.
fn asked(names: &[&str]) -> Result<Vec<String>, String> {
    let all = list()?;
    match names.iter().find(|name| !all.iter().any(|target| target == *name)) {
        Some(unknown) => Err(format!("there is no target {unknown}; there are {}", all.join(", "))),
        None if names.is_empty() => Ok(all),
        None => Ok(names.iter().map(|&name| name.to_owned()).collect()),
    }
}

struct Row {
    executions: String,
    seconds: f64,
    memory: String,
    findings: usize,
}

fn archive_of(target: &str) -> PathBuf {
    format!("fuzz/corpus/{target}.tar").into()
}

/// Unpacks the kept inputs into a folder of their own, which libFuzzer reads; the folder.
fn unpack(target: &str) -> Result<String, String> {
    let folder = empty(&format!("fuzz/target/kept/{target}"))?;
    for (name, content) in archive::open(&archive_of(target))? {
        let path = Path::new(&folder).join(name);
        std::fs::write(&path, content).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(folder)
}

/// The folder of this name, without what it held.
fn empty(folder: &str) -> Result<String, String> {
    if Path::new(folder).exists() {
        std::fs::remove_dir_all(folder).map_err(|e| format!("{folder}: {e}"))?;
    }
    std::fs::create_dir_all(folder).map_err(|e| format!("{folder}: {e}"))?;
    Ok(folder.to_owned())
}

/// Packs the smallest set that libFuzzer finds among the inputs kept and found.
fn keep(target: &str) -> Result<(), String> {
    let kept = unpack(target)?;
    let chosen = empty(&format!("fuzz/target/chosen/{target}"))?;
    let found = format!("fuzz/target/corpus/{target}");
    std::fs::create_dir_all(&found).map_err(|e| format!("{found}: {e}"))?;
    let flags = ["-set_cover_merge=1", LONGEST_KEPT];
    cargo_fuzz(
        &[&["run", "-s", "none", target, &chosen, &kept, &found, "--"], &flags[..]].concat(),
        Stdio::inherit(),
    )?;
    let mut inputs = Inputs::new();
    for file in std::fs::read_dir(&chosen).map_err(|e| format!("{chosen}: {e}"))? {
        let path = file.map_err(|e| format!("{chosen}: {e}"))?.path();
        let content = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().chars().take(NAME).collect();
        inputs.insert(name, content);
    }
    if inputs.is_empty() {
        return Err(format!("libFuzzer chose no input of {target}"));
    }
    println!("{target}: {} inputs kept", inputs.len());
    let path = archive_of(target);
    std::fs::write(&path, archive::pack(&inputs)).map_err(|e| format!("{}: {e}", path.display()))
}

/// New inputs go to a folder outside the repository, found by running on from the last time.
fn fuzz(target: &str, seconds: u32) -> Result<Row, String> {
    let found = format!("fuzz/target/corpus/{target}");
    let artifacts = format!("fuzz/artifacts/{target}");
    std::fs::create_dir_all(&found).map_err(|e| format!("{found}: {e}"))?;
    let before = count(&artifacts);
    let flags = [
        format!("-timeout={HANG}"),
        format!("-rss_limit_mb={MEMORY}"),
        format!("-max_total_time={seconds}"),
        "-print_final_stats=1".into(),
        "-max_len=16384".into(),
    ];
    let kept = unpack(target)?;
    let mut arguments = vec!["run", "-s", "none", target, &found, &kept, "--"];
    arguments.extend(flags.iter().map(String::as_str));
    let began = Instant::now();
    let output = cargo_fuzz(&arguments, Stdio::piped())?;
    let seconds = began.elapsed().as_secs_f64();
    let stat = |name: &str| {
        let line = output.lines().find_map(|line| line.strip_prefix(name));
        line.unwrap_or("unknown").trim().to_owned()
    };
    Ok(Row {
        executions: stat("stat::number_of_executed_units:"),
        seconds,
        memory: stat("stat::peak_rss_mb:"),
        findings: count(&artifacts) - before,
    })
}

fn list() -> Result<Vec<String>, String> {
    let output = Command::new("cargo").args(["fuzz", "list"]).output();
    let output = output.map_err(|error| format!("cargo cannot be run: {error}"))?;
    if !output.status.success() {
        return Err("`cargo fuzz list` failed; cargo install cargo-fuzz".into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect())
}

fn count(folder: &str) -> usize {
    std::fs::read_dir(Path::new(folder)).map_or(0, |entries| entries.count())
}

/// What `cargo fuzz` wrote to its error stream, which libFuzzer reports on. A finding makes it fail, so its exit
/// status counts for builds only.
fn cargo_fuzz(arguments: &[&str], stderr: Stdio) -> Result<String, String> {
    let output = Command::new("cargo")
        .arg("fuzz")
        .args(arguments)
        .env("RUSTC_BOOTSTRAP", "1")
        .stderr(stderr)
        .spawn()
        .and_then(|child| child.wait_with_output())
        .map_err(|error| format!("cargo cannot be run: {error}"))?;
    if arguments[0] == "build" && !output.status.success() {
        return Err("the targets do not build; cargo install cargo-fuzz".into());
    }
    Ok(String::from_utf8_lossy(&output.stderr).into_owned())
}
