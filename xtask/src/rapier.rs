//! The second solver, whose engine takes minutes to compile, and the command with it.

use crate::builds::{WEB_TARGET, node_missing, web_target_installed, web_target_missing};
use crate::built::{PROFILE, SAME_FEATURES};
use crate::command::{cargo, installed, succeed, target_folder, tests_of};
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

/// The second solver with stock rapier beside it, and what can have it: built as one, so that nothing is compiled twice.
const PACKAGES: &[&str] = &[
    "-p",
    "workspace-hack",
    "-p",
    "robohive-rapier",
    "-p",
    "robohive-bevy",
    "-p",
    "robohive-cli",
    "-p",
    "robohive-python",
    "--features",
    "robohive-rapier/stock,robohive-cli/rapier,robohive-python/rapier",
];

/// Programs that say whether they computed what they should: two examples, and the one in Bevy.
const PROGRAMS: [&str; 3] = ["examples/muscle_arm", "examples/bits", "quadruped"];

/// Lints it and what can have it, runs its tests and programs, documents it, asks the command for it, and compares its hashes of
/// small scenes with the recorded ones, here and in WebAssembly.
pub fn run() -> Outcome {
    let of_all =
        |verb: &[&str], rest: &[&str]| cargo(&[verb, &["--profile", PROFILE], PACKAGES, rest].concat());
    of_all(&["clippy"], &["--all-targets", "--", "-D", "warnings"])?;
    let tests = tests_of("src/rapier")?;
    let tests: Vec<&str> = tests.iter().map(String::as_str).collect();
    of_all(&["test"], &[&["--lib"], &tests[..]].concat())?;
    of_all(&["test", "--doc"], &[])?;
    of_all(&["test"], &["--test", "solver"])?;
    of_all(&["build"], &["--example", "muscle_arm", "--example", "bits", "--bin", "quadruped"])?;
    let folder = target_folder()?.join(PROFILE);
    for program in PROGRAMS {
        succeed(&mut Command::new(folder.join(format!("{program}{}", std::env::consts::EXE_SUFFIX))))?;
    }
    let package = ["--profile", PROFILE, "-p", "robohive-rapier"];
    let mut doc = Command::new("cargo");
    doc.args(["doc", "--no-deps"]).args(package).args(SAME_FEATURES).env("RUSTDOCFLAGS", "-D warnings");
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
