//! The second solver, whose engine takes minutes to compile, and the command with it.

use crate::builds::{WEB_TARGET, node_missing, web_target_installed, web_target_missing};
use crate::built::PROFILE;
use crate::command::{cargo, installed, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use std::process::Command;

/// What decides how models move under rapier.
pub const INPUTS: &[&str] = &[
    "src/physics",
    "src/rapier",
    "src/env",
    "src/teleop",
    "src/cli",
    "mjcf",
    "assets",
    "python/Cargo.toml",
    "python/src/request.rs",
];

/// Lints it, with stock rapier beside it and in what can have it, runs its tests and examples, documents it, asks the command for
/// it, and compares its hashes of small scenes with the recorded ones, here and in WebAssembly.
pub fn run() -> Outcome {
    let package = ["--profile", PROFILE, "-p", "robohive-rapier"];
    let command = ["--profile", PROFILE, "-p", "robohive-cli", "--features", "robohive-cli/rapier"];
    let stock = [&package[..], &["--features", "robohive-rapier/stock"]].concat();
    let bevy = ["--profile", PROFILE, "-p", "robohive-bevy"];
    let python = ["--profile", PROFILE, "-p", "robohive-python", "--features", "robohive-python/rapier"];
    for packages in [&package[..], &stock, &bevy, &command, &python] {
        cargo(&[&["clippy"][..], packages, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    }
    cargo(&[&["test"][..], &package].concat())?;
    for example in ["muscle_arm", "bits"] {
        cargo(&[&["run"][..], &package, &["--example", example]].concat())?;
    }
    cargo(&[&["run"][..], &bevy].concat())?;
    cargo(&[&["test"][..], &command, &["--test", "solver"]].concat())?;
    let mut doc = Command::new("cargo");
    doc.args(["doc", "--no-deps"]).args(package).env("RUSTDOCFLAGS", "-D warnings");
    succeed(&mut doc)?;
    Ok(web_bits(&package)?.into_iter().collect())
}

/// The example `bits` as a WebAssembly module, under node.
fn web_bits(package: &[&str]) -> Result<Option<Missing>, String> {
    let what = "rapier's hashes from WebAssembly";
    if !web_target_installed()? {
        return Ok(Some(web_target_missing(what)));
    }
    cargo(&[&["build"][..], package, &["--example", "bits", "--target", WEB_TARGET]].concat())?;
    if !installed("node") {
        return Ok(Some(node_missing(what)));
    }
    let module = target_folder()?.join(WEB_TARGET).join(PROFILE).join("examples/bits.wasm");
    succeed(Command::new("node").arg("src/rapier/examples/bits.mjs").arg(module))?;
    Ok(None)
}
