//! Continuous integration as a program. `cargo xtask ci` runs what every change must pass, in minutes; `cargo xtask long`
//! what takes longer; `cargo xtask release` what only a release needs; `cargo xtask NAME…` single checks. With `--strict`
//! what this machine cannot check counts as a failure.
//! `cargo xtask instructions --update` records new counts, `cargo xtask fuzz [SECONDS] [TARGET…]` fuzzes every decoder,
//! `cargo xtask crash-safety [KILLS]` kills recordings at random moments and reads what they leave,
//! `cargo xtask mutants [COUNT]` puts faults into the sources and sees whether tests notice.

mod builds;
mod check;
mod command;
mod crash_safety;
mod fuzz;
mod gpu;
mod instructions;
mod mutants;
mod packages;
mod python;
mod recorded_bits;
mod tolerances;

use check::{Check, Outcome, run_all};
use command::{cargo, succeed};
use std::process::ExitCode;

/// All packages but two that checks of their own build: the renderer that needs a GPU's interface, which takes minutes to
/// compile (`gpu`), and the extension module for Python (`python`).
const EVERYTHING: &[&str] =
    &["--workspace", "--exclude", "robohive-render-gpu", "--exclude", "robohive-python"];

const QUICK: [Check; 6] = [
    Check { name: "format", run: || cargo(&["fmt", "--all", "--check"]) },
    Check {
        name: "lint",
        run: || {
            cargo(
                &[&["clippy", "--profile", "ci"], EVERYTHING, &["--all-targets", "--", "-D", "warnings"]]
                    .concat(),
            )
        },
    },
    Check { name: "test", run: || cargo(&[&["test", "--profile", "ci"], EVERYTHING].concat()) },
    Check { name: "docs", run: docs },
    Check { name: "features", run: builds::features },
    Check { name: "python", run: python::run },
];

const LONG: [Check; 9] = [
    Check { name: "tolerances", run: tolerances::run },
    Check { name: "recorded-bits", run: recorded_bits::run },
    Check { name: "builds", run: builds::run },
    Check { name: "packages", run: packages::run },
    Check { name: "rust-version", run: packages::rust_version },
    Check { name: "instructions", run: || instructions::run(false) },
    Check { name: "gpu", run: gpu::run },
    Check { name: "python-docs", run: python::docs },
    Check { name: "python-learners", run: python::learners },
];

/// What is run before a release: it installs or builds much.
const RELEASE: [Check; 2] =
    [Check { name: "wheel", run: python::wheel }, Check { name: "python-cluster", run: python::cluster }];

fn main() -> ExitCode {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let strict = words.iter().position(|word| word == "--strict").map(|at| words.remove(at)).is_some();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["fuzz", ref rest @ ..] => verdict(fuzz::run(rest)),
        ["crash-safety", ref rest @ ..] => verdict(crash_safety::run(rest)),
        ["mutants", ref rest @ ..] => verdict(mutants::run(rest)),
        ["instructions", "--update"] => verdict(instructions::run(true).map(drop)),
        _ => match chosen(&words) {
            Some(checks) => verdict(run_all(&checks, strict)),
            None => usage(),
        },
    }
}

/// The checks that `words` name, singly or as `ci` and `long`; nothing where a word is unknown or there is none.
fn chosen<'a>(words: &[&str]) -> Option<Vec<&'a Check>> {
    let named = |word: &str| match word {
        "ci" => QUICK.iter().collect(),
        "long" => LONG.iter().collect(),
        "release" => RELEASE.iter().collect(),
        _ => QUICK.iter().chain(&LONG).chain(&RELEASE).filter(|check| check.name == word).collect::<Vec<_>>(),
    };
    let found: Vec<_> = words.iter().map(|word| named(word)).collect();
    let known = !found.is_empty() && found.iter().all(|checks| !checks.is_empty());
    known.then(|| found.concat())
}

fn usage() -> ExitCode {
    let names: Vec<_> = QUICK.iter().chain(&LONG).chain(&RELEASE).map(|check| check.name).collect();
    eprintln!("usage: cargo xtask [--strict] ci | long | release | {}", names.join(" | "));
    eprintln!("       cargo xtask instructions --update");
    eprintln!("       cargo xtask crash-safety [KILLS]");
    eprintln!("       cargo xtask mutants [COUNT]");
    eprintln!("       cargo xtask fuzz [SECONDS | keep] [TARGET...]");
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

fn docs() -> Outcome {
    let mut command = std::process::Command::new("cargo");
    command
        .args(["doc", "--profile", "ci"])
        .args(EVERYTHING)
        .arg("--no-deps")
        .env("RUSTDOCFLAGS", "-D warnings");
    succeed(&mut command).map(|()| Vec::new())
}
