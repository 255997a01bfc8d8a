//! Continuous integration as a program. `cargo xtask ci` runs what every change must pass; `cargo xtask long` what takes
//! longer, unless nothing that it depends on has changed since it last passed (`passed.txt`); `cargo xtask release` runs
//! all of it, always, and what only a release needs; `cargo xtask NAME…` runs single checks, always. With `--strict`
//! whatever this machine cannot check counts as a failure, with `--all` nothing is skipped.
//! `cargo xtask instructions --update` records new counts, `cargo xtask fuzz [SECONDS] [TARGET…]` fuzzes every decoder,
//! `cargo xtask crash-safety [KILLS]` kills recordings at random moments and reads what they leave,
//! `cargo xtask mutants [COUNT]` puts faults into the sources and sees whether tests notice,
//! `cargo xtask web [FOLDER]` builds the page and tests it in node and in a browser,
//! `cargo xtask site [FOLDER]` builds the documentation, checks its links and runs its code,
//! `cargo xtask results [TABLE…]` lists the tables of results by age, or makes them again.

mod builds;
mod built;
mod check;
mod clients;
mod command;
mod crash_safety;
mod fuzz;
mod gpu;
mod instructions;
mod mutants;
mod outcome;
mod packages;
mod passed;
mod python;
mod rapier;
mod recorded_bits;
mod results;
mod site;
mod tests;
mod tolerances;
#[cfg(feature = "web")]
mod web;
mod web_tools;
mod window;

use built::{EVERYTHING, PROFILE};
use check::{Check, Rules, run_all};
use command::cargo;
use outcome::Outcome;
use passed::NO_TESTS;
use std::process::ExitCode;

const QUICK: [Check; 5] = [
    Check { name: "format", inputs: &[], run: || cargo(&["fmt", "--all", "--check"]) },
    Check { name: "lint", inputs: &[], run: lint },
    Check { name: "test", inputs: &[], run: tests::run },
    Check { name: "docs", inputs: &[], run: docs },
    Check { name: "features", inputs: &[], run: builds::features },
];

const LONG: [Check; 13] = [
    Check { name: "python", inputs: python::INPUTS, run: python::run },
    Check { name: "recorded-bits", inputs: recorded_bits::INPUTS, run: recorded_bits::run },
    Check { name: "builds", inputs: builds::INPUTS, run: builds::run },
    Check { name: "packages", inputs: packages::INPUTS, run: packages::run },
    Check { name: "rust-version", inputs: &[], run: packages::rust_version },
    Check { name: "instructions", inputs: instructions::INPUTS, run: || instructions::run(false) },
    Check { name: "clients", inputs: clients::INPUTS, run: clients::run },
    Check { name: "rapier", inputs: rapier::INPUTS, run: rapier::run },
    Check { name: "gpu", inputs: gpu::INPUTS, run: gpu::run },
    Check { name: "window", inputs: window::INPUTS, run: window::run },
    Check { name: "page", inputs: PAGE_INPUTS, run: page },
    // Blocks of JavaScript and live models take the page.
    Check { name: "site", inputs: site::INPUTS, run: site::run },
    Check { name: "python-learners", inputs: python::INPUTS, run: python::learners },
];

/// What decides what the page shows and does.
const PAGE_INPUTS: &[&str] = &["src", NO_TESTS, "mjcf", "assets", "web", "xtask/src/web"];

/// What only a release needs: it installs or builds much.
const RELEASE: [Check; 4] = [
    Check { name: "dist", inputs: &[], run: builds::dist },
    Check { name: "publish", inputs: &[], run: packages::publish },
    Check { name: "wheel", inputs: &[], run: python::wheel },
    Check { name: "python-cluster", inputs: &[], run: python::cluster },
];

fn main() -> ExitCode {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let mut flag =
        |name: &str| words.iter().position(|word| word == name).map(|at| words.remove(at)).is_some();
    let (strict, all) = (flag("--strict"), flag("--all"));
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["fuzz", ref rest @ ..] => verdict(fuzz::run(rest)),
        ["crash-safety", ref rest @ ..] => verdict(crash_safety::run(rest)),
        ["mutants", ref rest @ ..] => verdict(mutants::run(rest)),
        ["results", ref rest @ ..] => verdict(results::run(rest)),
        ["web", ref rest @ ..] => verdict(web(rest)),
        ["site", folder] => verdict(site::build(folder.as_ref()).map(name_missing)),
        ["instructions", "--update"] => verdict(instructions::run(true).map(drop)),
        _ => match chosen(&words) {
            Some(checks) => {
                let skip = !all && words.iter().all(|word| ["ci", "long"].contains(word));
                verdict(run_all(&checks, Rules { strict, skip }))
            }
            None => usage(),
        },
    }
}

/// The checks that `words` name, singly or as `ci`, `long` and `release`; nothing where a word is unknown or there is none.
fn chosen<'a>(words: &[&str]) -> Option<Vec<&'a Check>> {
    let all = || QUICK.iter().chain(&LONG).chain(&RELEASE);
    let named = |word: &str| match word {
        "ci" => QUICK.iter().collect(),
        "long" => LONG.iter().collect(),
        "release" => all().collect(),
        _ => all().filter(|check| check.name == word).collect::<Vec<_>>(),
    };
    let found: Vec<_> = words.iter().map(|word| named(word)).collect();
    let known = !found.is_empty() && found.iter().all(|checks| !checks.is_empty());
    known.then(|| found.concat())
}

fn usage() -> ExitCode {
    let names: Vec<_> = QUICK.iter().chain(&LONG).chain(&RELEASE).map(|check| check.name).collect();
    eprintln!("usage: cargo xtask [--strict] [--all] ci | long | release | {}", names.join(" | "));
    eprintln!("       cargo xtask instructions --update");
    eprintln!("       cargo xtask crash-safety [KILLS]");
    eprintln!("       cargo xtask mutants [COUNT]");
    eprintln!("       cargo xtask results [TABLE...]");
    eprintln!("       cargo xtask fuzz [SECONDS | keep] [TARGET...]");
    eprintln!("       cargo xtask web [FOLDER]");
    eprintln!("       cargo xtask site FOLDER");
    ExitCode::from(2)
}

fn verdict(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("== failed: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn lint() -> Outcome {
    cargo(
        &[&["clippy", "--profile", PROFILE], EVERYTHING, &["--all-targets", "--", "-D", "warnings"]].concat(),
    )
}

fn docs() -> Outcome {
    built::document().map(|()| Vec::new())
}

/// Builds the page and tests it, where it can be built.
fn page() -> Outcome {
    if !builds::web_target_installed()? {
        return Ok(vec![builds::web_target_missing("the page")]);
    }
    web(&[])?;
    web_tools::missing()
}

/// Builds the page, in a program that has what makes its script.
#[cfg(not(feature = "web"))]
fn web(words: &[&str]) -> Result<(), String> {
    cargo(&[&["run", "--quiet", "--package", "xtask", "--features", "web", "--", "web"], words].concat())
        .map(drop)
}

/// Builds the page and tests it, and names what could not be tested.
#[cfg(feature = "web")]
fn web(words: &[&str]) -> Result<(), String> {
    web::run(words).map(name_missing)
}

/// Names what could not be checked.
fn name_missing(missing: Vec<outcome::Missing>) {
    missing
        .iter()
        .for_each(|missing| println!("== not checked: {}, to get it: {}", missing.what, missing.get));
}
