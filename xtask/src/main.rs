//! Continuous integration as a program: `cargo xtask ci` runs every check, `cargo xtask NAME` one of them.
//! `cargo xtask instructions --update` records the counts anew.

mod instructions;

use instructions::Trouble;
use std::process::{Command, ExitCode};
use std::time::Instant;

/// One check: its name and the cargo arguments that run it.
struct Check {
    name: &'static str,
    cargo: &'static [&'static str],
}

const CHECKS: &[Check] = &[
    Check { name: "format", cargo: &["fmt", "--all", "--check"] },
    Check {
        name: "lint",
        cargo: &["clippy", "--profile", "ci", "--workspace", "--all-targets", "--", "-D", "warnings"],
    },
    Check { name: "test", cargo: &["test", "--profile", "ci", "--workspace"] },
    Check { name: "docs", cargo: &["doc", "--profile", "ci", "--workspace", "--no-deps"] },
];

fn main() -> ExitCode {
    let asked: Vec<_> = std::env::args().skip(1).collect();
    let (name, update) = match asked.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [name] => (name, false),
        ["instructions", "--update"] => ("instructions", true),
        _ => ("", false),
    };
    let all = name == "ci";
    let chosen: Vec<_> = CHECKS.iter().filter(|c| all || name == c.name).collect();
    let count = all || name == "instructions";
    if chosen.is_empty() && !count {
        let names: Vec<_> = CHECKS.iter().map(|c| c.name).collect();
        eprintln!("usage: cargo xtask ci | {} | instructions [--update]", names.join(" | "));
        return ExitCode::from(2);
    }
    for check in chosen {
        let heading = format!("{}: cargo {}", check.name, check.cargo.join(" "));
        if let Err(reason) = timed(&heading, || cargo(check.cargo)) {
            eprintln!("== {} failed: {reason}", check.name);
            return ExitCode::FAILURE;
        }
    }
    if count {
        match timed("instructions", || instructions::run(update)) {
            Ok(()) => {}
            Err(Trouble::CannotCount(reason)) if all => println!("== instructions not compared: {reason}"),
            Err(Trouble::CannotCount(reason) | Trouble::Failed(reason)) => {
                eprintln!("== instructions failed: {reason}");
                return ExitCode::FAILURE;
            }
        }
    }
    println!("== all checks passed");
    ExitCode::SUCCESS
}

/// Runs `work` between a heading and its duration.
fn timed<T>(heading: &str, work: impl FnOnce() -> T) -> T {
    println!("== {heading}");
    let began = Instant::now();
    let result = work();
    println!("== took {:.0} s", began.elapsed().as_secs_f64());
    result
}

fn cargo(arguments: &[&str]) -> Result<(), String> {
    match Command::new("cargo").args(arguments).env("RUSTDOCFLAGS", "-D warnings").status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(status.to_string()),
        Err(error) => Err(format!("cargo cannot be run: {error}")),
    }
}
