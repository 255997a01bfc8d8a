//! `cargo xtask fuzz [SECONDS] [TARGET…]`: libFuzzer on every target of `fuzz/`, or on those named, one after the other,
//! as a table. Needs `cargo install cargo-fuzz` and a C++ compiler.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// A unit that takes longer [s] is a finding.
const HANG: u32 = 1;
/// More memory [MB] is a finding.
const MEMORY: u32 = 1024;

/// Seconds for each target where the command line names none.
const SECONDS: u32 = 600;

/// Runs each of the targets that the words name, or every one, for the seconds that the first word gives; an error
/// when there is a finding.
pub fn run(words: &[&str]) -> Result<(), String> {
    let (seconds, asked) = match words.split_first().map(|(first, rest)| (first.parse(), rest)) {
        Some((Ok(seconds), rest)) => (seconds, rest),
        _ => (SECONDS, words),
    };
    let asked: Vec<String> = asked.iter().map(|&name| name.to_owned()).collect();
    let all = list()?;
    if let Some(unknown) = asked.iter().find(|name| !all.contains(name)) {
        return Err(format!("there is no target {unknown}; there are {}", all.join(", ")));
    }
    let targets = if asked.is_empty() { &all } else { &asked };
    cargo_fuzz(&["build", "-s", "none"], Stdio::inherit())?;
    let mut findings = 0;
    println!("| target | executions | seconds | peak memory [MB] | findings |\n|---|---|---|---|---|");
    for target in targets {
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

struct Row {
    executions: String,
    seconds: f64,
    memory: String,
    findings: usize,
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
    let kept = format!("fuzz/corpus/{target}");
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
