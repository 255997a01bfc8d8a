//! Continuous integration as a program: `cargo xtask ci` runs every check, `cargo xtask NAME` one of them.
//! `cargo xtask instructions --update` records the counts anew, `cargo xtask fuzz [SECONDS] [TARGET…]` fuzzes every decoder.

mod builds;
mod fuzz;
mod instructions;

use std::process::{Command, ExitCode};
use std::time::Instant;

/// Why a check did not pass.
pub enum Trouble {
    /// This machine lacks what it takes.
    CannotCheck(String),
    /// A command failed, or a number is wrong.
    Failed(String),
}

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
    if let Some(("fuzz", rest)) = asked.split_first().map(|(first, rest)| (first.as_str(), rest)) {
        return fuzz(rest);
    }
    let (name, update) = match asked.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [name] => (name, false),
        ["instructions", "--update"] => ("instructions", true),
        _ => ("", false),
    };
    let names: Vec<_> = CHECKS.iter().map(|c| c.name).chain(["builds", "instructions"]).collect();
    if name != "ci" && !names.contains(&name) {
        eprintln!("usage: cargo xtask ci | {} [--update] | fuzz [SECONDS] [TARGET...]", names.join(" | "));
        return ExitCode::from(2);
    }
    for one in names.into_iter().filter(|n| name == "ci" || name == *n) {
        let outcome = timed(one, || check(one, update));
        match outcome {
            Ok(()) => {}
            Err(Trouble::CannotCheck(reason)) if name == "ci" => println!("== {one} not checked: {reason}"),
            Err(Trouble::CannotCheck(reason) | Trouble::Failed(reason)) => {
                eprintln!("== {one} failed: {reason}");
                return ExitCode::FAILURE;
            }
        }
    }
    println!("== all checks passed");
    ExitCode::SUCCESS
}

/// Fuzzes for the seconds asked for, or ten minutes a target: those named, or all.
fn fuzz(arguments: &[String]) -> ExitCode {
    let (seconds, targets) = match arguments.split_first().map(|(first, rest)| (first.parse(), rest)) {
        Some((Ok(seconds), rest)) => (seconds, rest),
        _ => (600, arguments),
    };
    match fuzz::run(seconds, targets) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("== fuzz: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the check called `name`.
fn check(name: &str, update: bool) -> Result<(), Trouble> {
    match CHECKS.iter().find(|c| c.name == name) {
        Some(check) => cargo(check.cargo).map_err(Trouble::Failed),
        None if name == "builds" => builds::run(),
        None => instructions::run(update),
    }
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
