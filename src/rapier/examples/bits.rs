//! The state of every small scene after a second, hashed: the same bits on every machine, if rapier keeps its promise.
//!
//! ```sh
//! cargo run -p robohive-rapier --example bits
//! ```
//!
//! prints the hashes and fails unless they are those of `bits.txt`. So does the same program as a WebAssembly module, which
//! has no output but whether it failed (`bits.mjs`).

#[path = "beside/scenes.rs"]
mod scenes;

use robohive_rapier::{Options, engine};
use scenes::{SCENES, controls, start, steps};
use std::error::Error;
use std::process::ExitCode;

/// The recorded hashes, rows of the table in `validation/results/rapier.md`.
const RECORDED: &str = include_str!("bits.txt");

/// FNV-1a over the bits of positions and velocities.
fn hash(text: &str) -> Result<u64, Box<dyn Error>> {
    let m = mjcf::load_str(text)?.model;
    let mut mover = engine(Options::default()).start(&m)?;
    let mut d = start(&m);
    for _ in 0..steps(&m) {
        let time = d.time();
        controls(&m, time, &mut d.state.ctrl);
        mover.step(&m, &mut d)?;
    }
    let bytes = d.state.qpos.iter().chain(&d.state.qvel).flat_map(|x| x.to_bits().to_le_bytes());
    Ok(bytes
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)))
}

fn main() -> ExitCode {
    let mut recorded = RECORDED.lines();
    let mut alike = true;
    for (name, text) in SCENES {
        let row = match hash(text) {
            Ok(hash) => format!("| {name} | {hash:016x} |"),
            Err(error) => format!("| {name} | {error} |"),
        };
        let same = recorded.next() == Some(&row);
        println!("{row}{}", if same { "" } else { " differs from bits.txt" });
        alike &= same;
    }
    if alike && recorded.next().is_none() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
