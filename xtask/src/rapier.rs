//! The second solver, whose engine takes minutes to compile, and the command with it.

use crate::built::PROFILE;
use crate::command::{cargo, succeed};
use crate::outcome::Outcome;
use std::process::Command;

/// What decides how models move under rapier.
pub const INPUTS: &[&str] = &[
    "src/physics",
    "src/rapier",
    "src/env",
    "src/cli",
    "mjcf",
    "assets",
    "python/Cargo.toml",
    "python/src/request.rs",
];

/// Lints it, with stock rapier beside it and in what can have it, runs its tests and examples, documents it, compiles it for
/// WebAssembly, and asks the command for it.
pub fn run() -> Outcome {
    let package = ["--profile", PROFILE, "-p", "robohive-rapier"];
    let command = ["--profile", PROFILE, "-p", "robohive-cli", "--features", "robohive-cli/rapier"];
    let stock = [&package[..], &["--features", "robohive-rapier/stock"]].concat();
    let python = ["--profile", PROFILE, "-p", "robohive-python", "--features", "robohive-python/rapier"];
    for packages in [&package[..], &stock, &command, &python] {
        cargo(&[&["clippy"][..], packages, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    }
    cargo(&[&["test"][..], &package].concat())?;
    cargo(&[&["run"][..], &package, &["--example", "muscle_arm"]].concat())?;
    cargo(&[&["test"][..], &command, &["--test", "solver"]].concat())?;
    cargo(&[&["check"][..], &package, &["--target", "wasm32-unknown-unknown"]].concat())?;
    let mut doc = Command::new("cargo");
    doc.args(["doc", "--no-deps"]).args(package).env("RUSTDOCFLAGS", "-D warnings");
    succeed(&mut doc)?;
    Ok(Vec::new())
}
