//! The GPU renderer, where the machine has a GPU or a driver that stands in for one.

use crate::built::{GRAPHICS, PROFILE};
use crate::command::{cargo, output, tests_of};
use crate::outcome::{Missing, Outcome};
use std::process::Command;

/// What its tests print where there is no GPU.
const ABSENT: &str = "not checked: there is no GPU";

/// What decides the pictures and the comparison.
pub const INPUTS: &[&str] = &["src", "mjcf", "assets", "validation"];

/// Lints what draws by a GPU or opens windows, runs the tests of the renderer and the command's pictures by a GPU, and sees from
/// what they print whether anything was drawn.
pub fn run() -> Outcome {
    let clippy = ["clippy", "--profile", PROFILE, "--all-targets"];
    cargo(&[&clippy[..], GRAPHICS, &["--", "-D", "warnings"]].concat())?;
    cargo(&[&["test", "--doc", "--quiet", "--profile", PROFILE], GRAPHICS].concat())?;
    let renderer = tests_of("src/render_gpu")?;
    let renderer: Vec<&str> = renderer.iter().map(String::as_str).collect();
    drawn(&[&["--lib", "--test", "gpu"], &renderer[..]].concat())
}

/// Runs programs of tests that draw by a GPU, and sees from what they print whether there was one.
pub fn drawn(names: &[&str]) -> Outcome {
    let mut test = Command::new("cargo");
    test.args(["test", "--profile", PROFILE]).args(GRAPHICS).args(names).args(["--", "--nocapture"]);
    if !output(&mut test)?.0.contains(ABSENT) {
        return Ok(Vec::new());
    }
    Ok(vec![Missing::new(
        "pictures of a GPU beside those of the CPU (there is none)",
        "run on a machine with a GPU, or install a driver that computes on the CPU (apt-get install mesa-vulkan-drivers)",
    )])
}
