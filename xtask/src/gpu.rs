//! The GPU renderer, where the machine has a GPU or a driver that stands in for one.

use crate::command::{output, succeed};
use crate::outcome::{Missing, Outcome};
use std::process::Command;

/// What its tests print where there is no GPU.
const ABSENT: &str = "not checked: there is no GPU";

/// What decides the pictures and the comparison.
pub const INPUTS: &[&str] = &["src", "mjcf", "assets", "validation"];

/// Lints what is built for it alone, runs its tests, and sees from what they print whether anything was drawn.
pub fn run() -> Outcome {
    let packages = ["-p", "robohive-render-gpu", "-p", "robohive-validation", "-p", "robohive-cli"];
    let features = ["--features", "robohive-validation/gpu,robohive-cli/gpu"];
    let mut lint = Command::new("cargo");
    lint.args(["clippy", "--profile", crate::built::PROFILE, "--all-targets"]).args(packages).args(features);
    succeed(lint.args(["--", "-D", "warnings"]))?;
    let renderer = ["-p", "robohive-render-gpu"].as_slice();
    let command = ["-p", "robohive-cli", "--features", "robohive-cli/gpu", "--test", "gpu"].as_slice();
    drawn(&[renderer, command])
}

/// Runs tests that draw by a GPU, and sees from what they print whether there was one.
pub fn drawn(all: &[&[&str]]) -> Outcome {
    let mut absent = false;
    for tests in all {
        let mut test = Command::new("cargo");
        test.args(["test", "--profile", crate::built::PROFILE]).args(*tests).args(["--", "--nocapture"]);
        absent |= output(&mut test)?.0.contains(ABSENT);
    }
    if !absent {
        return Ok(Vec::new());
    }
    Ok(vec![Missing::new(
        "pictures of a GPU beside those of the CPU (there is none)",
        "run on a machine with a GPU, or install a driver that computes on the CPU (apt-get install mesa-vulkan-drivers)",
    )])
}
