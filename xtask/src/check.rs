//! Checks one after the other, and the account of what passed, what failed, and what this machine could not check.

use std::time::Instant;

/// Something that this machine cannot check.
pub struct Missing {
    /// What is not checked, and what the machine lacks for it.
    pub what: String,
    /// How to get what is missing.
    pub get: String,
}

impl Missing {
    /// Not checked: `what`; to get it: `get`.
    pub fn new(what: impl Into<String>, get: impl Into<String>) -> Self {
        Missing { what: what.into(), get: get.into() }
    }
}

/// The parts of a check that this machine could not run; an error where a part failed.
pub type Outcome = Result<Vec<Missing>, String>;

/// One check.
pub struct Check {
    /// Its name on the command line.
    pub name: &'static str,
    /// Runs it.
    pub run: fn() -> Outcome,
}

/// Runs `checks` until one fails and prints the account; under `strict`, parts that could not be checked are a failure.
pub fn run_all(checks: &[&Check], strict: bool) -> Result<(), String> {
    let mut missing = Vec::new();
    for check in checks {
        missing.extend(timed(check.name, check.run).map_err(|reason| format!("{}: {reason}", check.name))?);
    }
    for Missing { what, get } in &missing {
        println!("== not checked: {what}, to get it: {get}");
    }
    let account = format!("{} checks passed, {} things not checked", checks.len(), missing.len());
    if strict && !missing.is_empty() {
        return Err(format!("{account}; --strict asks for all"));
    }
    println!("== {account}");
    Ok(())
}

/// Runs `work` between a heading and the time it took.
fn timed<T>(heading: &str, work: impl FnOnce() -> T) -> T {
    println!("== {heading}");
    let (began, processor) = (Instant::now(), processor_seconds());
    let result = work();
    let spent = processor_seconds().zip(processor).map(|(after, before)| after - before);
    let spent = spent.map_or(String::new(), |seconds| format!(", {seconds:.0} s of processor time"));
    println!("== took {:.0} s{spent}", began.elapsed().as_secs_f64());
    result
}

/// Processor time of all child processes that have ended [s], where Linux tells it.
fn processor_seconds() -> Option<f64> {
    // `man 5 proc_pid_stat`: fields 16 and 17, in ticks of 1/100 s; the name in parentheses may hold spaces.
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(16)? + ticks(17)?) / 100.0)
}
