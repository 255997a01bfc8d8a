//! Simulated devices under clients that other people wrote.

use crate::built::PROFILE;
use crate::command::cargo;
use crate::outcome::Outcome;

/// What decides what the clients meet.
pub const INPUTS: &[&str] =
    &["src/protocol", "src/wire", "src/physics", "src/robot", "mjcf", "validation/clients"];

/// Lints the tests with other people's clients, and runs them.
pub fn run() -> Outcome {
    let package = ["--profile", PROFILE, "-p", "robohive-clients", "-p", "workspace-hack"];
    cargo(&[&["clippy"][..], &package, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    cargo(&[&["test"][..], &package].concat())
}
