//! Continuous integration as a program: `cargo xtask ci` runs every check, `cargo xtask NAME` one of them.

use std::process::{Command, ExitCode};
use std::time::Instant;

/// One check: its name and the cargo arguments that run it.
struct Check {
    name: &'static str,
    cargo: &'static [&'static str],
}

const CHECKS: &[Check] = &[
    Check { name: "format", cargo: &["fmt", "--all", "--check"] },
    Check {
        name: "lint",
        cargo: &["clippy", "--profile", "ci", "--workspace", "--all-targets", "--", "-D", "warnings"],
    },
    Check { name: "test", cargo: &["test", "--profile", "ci", "--workspace"] },
    Check { name: "docs", cargo: &["doc", "--profile", "ci", "--workspace", "--no-deps"] },
];

fn main() -> ExitCode {
    let asked = std::env::args().nth(1).unwrap_or_default();
    let chosen: Vec<_> = CHECKS.iter().filter(|c| asked == "ci" || asked == c.name).collect();
    if chosen.is_empty() {
        let names: Vec<_> = CHECKS.iter().map(|c| c.name).collect();
        eprintln!("usage: cargo xtask ci | {}", names.join(" | "));
        return ExitCode::from(2);
    }
    for check in chosen {
        println!("== {}: cargo {}", check.name, check.cargo.join(" "));
        let began = Instant::now();
        let status = Command::new("cargo").args(check.cargo).env("RUSTDOCFLAGS", "-D warnings").status();
        println!("== {} took {:.0} s", check.name, began.elapsed().as_secs_f64());
        match status {
            Ok(status) if status.success() => {}
            Ok(status) => {
                eprintln!("== {} failed: {status}", check.name);
                return ExitCode::FAILURE;
            }
            Err(error) => {
                eprintln!("== cargo cannot be run: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    println!("== all checks passed");
    ExitCode::SUCCESS
}
