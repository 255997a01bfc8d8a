//! Checks one after the other, and the account of what passed, what failed, how long each took, and what this machine
//! could not check.

use crate::outcome::{Missing, Outcome};
use crate::passed::Record;
use std::time::Instant;

/// One check.
pub struct Check {
    /// Its name on the command line.
    pub name: &'static str,
    /// Files and folders that decide its outcome. While none of them has changed since the commit at which it last passed,
    /// `cargo xtask long` skips it. A check without inputs is never skipped.
    pub inputs: &'static [&'static str],
    /// Runs it.
    pub run: fn() -> Outcome,
}

/// What continuous integration does not check, each with the reason; anything else that it cannot check is a failure there.
const NOT_IN_CI: [(&str, &str); 13] = [
    ("pictures of a GPU", "its machines have no GPU"),
    ("Python environments by the checkers of Stable-Baselines3 and TorchRL", "torch is a gigabyte"),
    ("windows from Python on a virtual display", "some of its machines have none"),
    ("controllers of an OpenXR runtime", "some of its machines have no OpenGL"),
    ("the library for WebAssembly", "some of its machines cannot add compilation targets"),
    ("hashes from WebAssembly", "some of its machines cannot add compilation targets"),
    ("the page (the target", "some of its machines cannot add compilation targets"),
    ("the page in", "some of its machines have no browser"),
    ("the build with wide vectors", "some of its processors lack AVX2"),
    ("the site in a browser", "some of its machines have no browser"),
    ("blocks of the site for lack of the npm package", "some of its machines cannot add compilation targets"),
    ("blocks of the site for lack of packages that blocks of Python import", "they are gigabytes"),
    (
        "equality with MuJoCo to the last bit",
        "the C library of its machines may be another than the recorded one",
    ),
];

/// How the checks of a run are done.
#[derive(Clone, Copy)]
pub struct Rules {
    /// Whatever this machine cannot check is a failure.
    pub strict: bool,
    /// Skip checks whose inputs have not changed since they passed.
    pub skip: bool,
}

/// A check that was run or skipped.
struct Row {
    name: &'static str,
    verdict: Verdict,
    /// Elapsed and processor time \[s\].
    seconds: [f64; 2],
}

enum Verdict {
    Passed,
    Skipped { commit: String },
    Failed(String),
}

/// Runs all `checks`, also after one has failed, and prints the account; an error names those that failed.
pub fn run_all(checks: &[&Check], rules: Rules) -> Result<(), String> {
    let mut record = Record::read()?;
    let (mut rows, mut missing) = (Vec::new(), Vec::new());
    for check in checks {
        println!("== {}", check.name);
        rows.push(run(check, rules, &mut record, &mut missing));
    }
    record.write()?;
    report(&rows, &missing);
    let failed: Vec<_> =
        rows.iter().filter(|row| matches!(row.verdict, Verdict::Failed(_))).map(|row| row.name).collect();
    if !failed.is_empty() {
        return Err(failed.join(", "));
    }
    let excused = |missing: &Missing| NOT_IN_CI.iter().any(|(what, _)| missing.what.starts_with(what));
    let needed = missing.iter().filter(|missing| rules.strict || in_ci() && !excused(missing));
    match needed.count() {
        0 => Ok(()),
        count => Err(format!("{count} things could not be checked that must be")),
    }
}

/// Runs one check, unless it may be skipped, and records that it passed.
fn run(check: &Check, rules: Rules, record: &mut Record, missing: &mut Vec<Missing>) -> Row {
    let unchanged = record.unchanged_since(check.name, check.inputs);
    if let Some(commit) = unchanged.filter(|_| rules.skip) {
        println!("== skipped: nothing it depends on has changed since commit {commit}, at which it passed");
        return Row { name: check.name, verdict: Verdict::Skipped { commit }, seconds: [0.0; 2] };
    }
    let (began, processor) = (Instant::now(), processor_seconds());
    let outcome = (check.run)();
    let seconds = [began.elapsed().as_secs_f64(), processor_seconds() - processor];
    println!("== took {:.0} s, {:.0} s of processor time", seconds[0], seconds[1]);
    let verdict = match outcome {
        Ok(lacking) => {
            if lacking.is_empty() {
                record.passed(check.name, check.inputs);
            }
            missing.extend(lacking);
            Verdict::Passed
        }
        Err(reason) => {
            eprintln!("== failed: {reason}");
            Verdict::Failed(reason)
        }
    };
    Row { name: check.name, verdict, seconds }
}

fn report(rows: &[Row], missing: &[Missing]) {
    println!("\n{:18} {:>8} {:>10}", "check", "time [s]", "processor");
    for Row { name, verdict, seconds: [elapsed, processor] } in rows {
        let note = match verdict {
            Verdict::Passed => String::new(),
            Verdict::Skipped { commit } => format!("skipped, unchanged since {commit}"),
            Verdict::Failed(reason) => format!("FAILED: {reason}"),
        };
        println!("{name:18} {elapsed:>8.0} {processor:>10.0}  {note}");
    }
    let total = |which: usize| rows.iter().map(|row| row.seconds[which]).sum::<f64>();
    println!("{:18} {:>8.0} {:>10.0}\n", "all", total(0), total(1));
    for Missing { what, get } in missing {
        let reason = NOT_IN_CI.iter().find(|(start, _)| what.starts_with(start));
        let reason = reason.filter(|_| in_ci()).map_or(String::new(), |(_, reason)| format!(" ({reason})"));
        println!("== not checked{reason}: {what}, to get it: {get}");
    }
    let count = |of: fn(&Verdict) -> bool| rows.iter().filter(|row| of(&row.verdict)).count();
    println!(
        "== {} checks passed, {} failed, {} skipped as unchanged, {} things not checked",
        count(|verdict| matches!(verdict, Verdict::Passed)),
        count(|verdict| matches!(verdict, Verdict::Failed(_))),
        count(|verdict| matches!(verdict, Verdict::Skipped { .. })),
        missing.len()
    );
}

/// Whether this is continuous integration, which sets `CI`.
fn in_ci() -> bool {
    std::env::var_os("CI").is_some_and(|value| !value.is_empty() && value != "false")
}

/// Processor time of all child processes that have ended \[s\]; 0 where the system does not tell it as Linux does.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // `man 5 proc_pid_stat`: fields 16 and 17, in ticks of 1/100 s; the name in parentheses may hold spaces.
    let fields: Vec<&str> =
        stat.rsplit_once(')').map_or(Vec::new(), |(_, rest)| rest.split_whitespace().collect());
    let ticks = |field: usize| fields.get(field - 3).and_then(|text| text.parse::<f64>().ok()).unwrap_or(0.0);
    (ticks(16) + ticks(17)) / 100.0
}
