//! Equality with the recorded MuJoCo to the last bit: the engine is built to call the C library's transcendental functions,
//! as MuJoCo does, and must then compute every recorded value of the own models. This needs the same C library as the
//! recording's.

use crate::command::target_folder;
use crate::outcome::{Missing, Outcome};
use crate::passed::NO_TESTS;
use std::process::Command;

/// Exit code of `robohive-validation bits` where the C library's functions are others.
const OTHER_LIBRARY: i32 = 3;

/// What decides the comparison.
pub const INPUTS: &[&str] = &[
    "src",
    NO_TESTS,
    "mjcf",
    "assets",
    "validation/src",
    "validation/reference/own",
    "validation/results/bits.md",
];

/// Builds the engine on the C library's functions, apart from other builds, and compares.
pub fn run() -> Outcome {
    let mut command = Command::new("cargo");
    command
        .args([
            "run",
            "--quiet",
            "--profile",
            crate::built::PROFILE,
            "-p",
            "robohive-validation",
            "--",
            "bits",
        ])
        .env("RUSTFLAGS", "--cfg system_math");
    let folder = target_folder()?.join("system-math");
    let status = command.env("CARGO_TARGET_DIR", folder).status().map_err(|error| error.to_string())?;
    match status.code() {
        Some(0) => Ok(Vec::new()),
        Some(OTHER_LIBRARY) => Ok(vec![Missing::new(
            "equality with MuJoCo to the last bit (the C library's functions are not those of the recorded run)",
            "run on x86-64 Linux with glibc 2.36 and a processor with fused multiply-add",
        )]),
        _ => Err(format!("{command:?}: {status}")),
    }
}
