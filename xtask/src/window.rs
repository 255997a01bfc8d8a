//! The window, driven without a display; what it is built of is linted with the GPU renderer (`gpu`).

use crate::built::{GRAPHICS, PROFILE};
use crate::command::cargo;
use crate::gpu;
use crate::outcome::Outcome;

/// What decides what the window shows and does.
pub const INPUTS: &[&str] = &["src", "mjcf", "assets"];

/// Runs the tests of the window and of the command that opens it.
pub fn run() -> Outcome {
    let test = [&["test", "--profile", PROFILE][..], GRAPHICS].concat();
    cargo(&[&test[..], &["--lib", "--test", "window", "--test", "served"]].concat())?;
    cargo(&[&test[..], &["--bin", "robohive", "view::"]].concat())?;
    gpu::drawn(&["--test", "painters"])
}
