//! Every tolerance of the comparisons with MuJoCo beside what is measured: a bound that is hardly kept breaks at the next
//! change of an order of operations, and one that is never approached notices nothing.

use crate::check::Outcome;
use crate::command::output;
use std::collections::BTreeMap;
use std::process::Command;

/// Bounds are between these multiples of the largest difference measured.
const MARGIN: [f64; 2] = [10.0, 100.0];

/// Runs the comparisons on the own models and prints the table; an error where a bound is too tight or too loose.
pub fn run() -> Outcome {
    let arguments = ["test", "--profile", "ci", "-p", "robohive-validation", "--tests", "--", "--nocapture"];
    let (text, _) = output(Command::new("cargo").args(arguments).env_remove("ROBOHIVE_REFERENCES"))?;
    let measured = parse(&text);
    if measured.is_empty() {
        return Err("no comparison printed what it measured".into());
    }
    let mut wrong = Vec::new();
    println!("{:24} {:>9} {:>9} {:>6}", "tolerance", "measured", "bound", "ratio");
    for (name, [largest, bound]) in measured {
        let ratio = bound / largest;
        println!("{name:24} {largest:>9.1e} {bound:>9.0e} {ratio:>6.0}");
        if !(MARGIN[0]..=MARGIN[1]).contains(&ratio) {
            wrong.push(name);
        }
    }
    if wrong.is_empty() {
        return Ok(Vec::new());
    }
    Err(format!("not {} to {} times what is measured: {}", MARGIN[0], MARGIN[1], wrong.join(", ")))
}

/// The largest difference and the bound by name, from lines as in `measured STAGE 7.4e-15 of 2e-13`.
fn parse(text: &str) -> BTreeMap<&str, [f64; 2]> {
    let mut found: BTreeMap<&str, [f64; 2]> = BTreeMap::new();
    for line in text.lines().filter_map(|line| line.split_once("measured ").map(|(_, rest)| rest)) {
        if let [name, largest, "of", bound] = line.split_whitespace().collect::<Vec<_>>()[..]
            && let (Ok(largest), Ok(bound)) = (largest.parse::<f64>(), bound.parse())
        {
            let row = found.entry(name).or_insert([0.0, bound]);
            row[0] = row[0].max(largest);
        }
    }
    found
}
