//! Prints every hash and compares it with the recorded one.

use robohive_digest::{hash, names, recorded};
use std::process::ExitCode;

const USAGE: &str = "usage: robohive-digest [--threads N] [--table]

Steps every model, draws pictures and trains policies, prints each hash and whether it is the recorded one; exit code 1 when one is not.
With --table prints lines as digests.txt has them, to record hashes again after a change of the numerics.";

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

/// Whether every hash is the recorded one, or the table was asked for.
fn run() -> Result<bool, String> {
    let (mut threads, mut table) = (1, false);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--threads" => {
                threads = words.next().and_then(|n| n.parse().ok()).filter(|n| *n > 0).ok_or(USAGE)?;
            }
            "--table" => table = true,
            _ => return Err(USAGE.into()),
        }
    }
    let mut equal = true;
    for (number, name) in names().enumerate() {
        let hash = hash(number, threads)?;
        if table {
            println!("{name} {hash:016x}");
            continue;
        }
        let same = recorded(name) == Some(hash);
        println!("{name:28} {hash:016x} {}", if same { "as recorded" } else { "DIFFERS" });
        equal &= same;
    }
    Ok(equal)
}
