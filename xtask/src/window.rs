//! The window: built, linted and driven without a display. It has twice the dependencies of everything else, so that no other
//! check builds it.

use crate::built::PROFILE;
use crate::command::cargo;
use crate::gpu;
use crate::outcome::Outcome;

/// What decides what the window shows and does.
pub const INPUTS: &[&str] = &["src", "mjcf", "assets"];

/// Lints the window and the command that opens it, and runs the tests of both.
pub fn run() -> Outcome {
    let packages = ["-p", "robohive-viewer", "-p", "robohive-cli"];
    let features = ["--features", "robohive-viewer/window,robohive-cli/window"];
    let clippy = ["clippy", "--profile", PROFILE];
    cargo(&[&clippy[..], &packages, &features, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    let test = ["test", "--profile", PROFILE];
    let viewer = ["-p", "robohive-viewer", "--features", "robohive-viewer/window"];
    cargo(&[&test[..], &viewer, &["--lib", "--test", "window", "--test", "served"]].concat())?;
    let command = ["-p", "robohive-cli", "--features", "robohive-cli/window", "--bin", "robohive"];
    cargo(&[&test[..], &command, &["view::"]].concat())?;
    gpu::drawn(&[&[&viewer[..], &["--test", "painters"]].concat()])
}
