//! `cargo xtask mutants [COUNT]`: whether the tests notice faults. cargo-mutants changes one operator or result of
//! `src/physics` at a time and runs the tests; what they let pass is printed and recorded. Needs `cargo install cargo-mutants`.

use crate::command::output;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// The packages whose tests are run: the crate itself, the compiler, comparisons with recorded runs, and the facade.
const TESTED_BY: &str = "robohive-physics,robohive-mjcf,robohive-validation,robohive";
/// Mutants tested where the command line names no number.
const COUNT: usize = 300;
/// A test run that takes longer \[s\] has met a loop without end.
const TIMEOUT: &str = "300";
const TABLE: &str = "validation/results/mutants.md";
/// Where cargo-mutants leaves its logs, within this folder.
const LOGS: &str = "target/mutants";
/// The outcomes, each with the file of those that met it.
const OUTCOMES: [(&str, &str); 4] = [
    ("caught by a test", "caught.txt"),
    ("not noticed", "missed.txt"),
    ("endless loop", "timeout.txt"),
    ("does not compile", "unviable.txt"),
];

/// Tests mutants spread evenly over all of them, always the same ones of the same sources, and records the outcome.
pub fn run(words: &[&str]) -> Result<(), String> {
    let count = match words {
        [] => COUNT,
        [word] => word.parse().ok().filter(|&n| n > 0).ok_or("usage: cargo xtask mutants [COUNT]")?,
        _ => return Err("usage: cargo xtask mutants [COUNT]".into()),
    };
    let package = ["mutants", "-p", "robohive-physics"];
    let list = output(Command::new("cargo").args(package).arg("--list"))
        .map_err(|error| format!("{error}\ncargo install cargo-mutants"))?;
    let all = list.0.lines().count();
    let shard = format!("0/{}", (all / count).max(1));
    let mut command = Command::new("cargo");
    command.args(package).args(["--shard", &shard, "--sharding", "round-robin", "--timeout", TIMEOUT]);
    command.args(["--test-package", TESTED_BY, "--output", LOGS]);
    // All but the slowest comparisons.
    command.args(["--", "--lib", "--tests", "--", "--skip", "laws_hold", "--skip", "draws"]);
    std::fs::create_dir_all(LOGS).map_err(|error| format!("{LOGS}: {error}"))?;
    // It fails where a mutant is not noticed, which the table says.
    command.status().map_err(|error| format!("{command:?}: {error}"))?;
    let table = table(all, count)?;
    print!("{table}");
    std::fs::write(TABLE, table).map_err(|error| format!("{TABLE}: {error}"))
}

/// The outcome of the last run, of `count` mutants asked for.
fn table(all: usize, count: usize) -> Result<String, String> {
    let folder = Path::new(LOGS).join("mutants.out");
    let read = |file: &str| {
        let path = folder.join(file);
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut numbers = [0; OUTCOMES.len()];
    for (number, (_, file)) in numbers.iter_mut().zip(OUTCOMES) {
        *number = read(file)?.lines().count();
    }
    let [caught, missed, endless, _] = numbers;
    let share = 100.0 * (caught + endless) as f64 / (caught + missed + endless).max(1) as f64;
    let mut text = format!(
        "# Mutants\n\nFaults put into `src/physics` one at a time, and whether the tests notice them: {} of {all} possible ones, \
         spread\nevenly. Of those that compile {share:.0} % are noticed by the tests of `robohive-physics`, `robohive-mjcf`,\n\
         `robohive-validation` and `robohive`.\n\n```sh\ncargo install cargo-mutants\n\
         cargo xtask mutants {count}\n```\n\n| outcome | mutants |\n|---|---|\n",
        numbers.iter().sum::<usize>()
    );
    for ((outcome, _), number) in OUTCOMES.iter().zip(numbers) {
        let _ = writeln!(text, "| {outcome} | {number} |");
    }
    text.push_str("\nNot noticed:\n\n");
    read("missed.txt")?.lines().for_each(|line| _ = writeln!(text, "- `{line}`"));
    Ok(text)
}
