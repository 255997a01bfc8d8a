//! `teleop`: a person drives an environment by hand and records demonstrations.

#[cfg_attr(not(unix), allow(dead_code))]
mod arguments;
#[cfg_attr(not(unix), allow(dead_code))]
mod device;
#[cfg(unix)]
mod drive;
#[cfg(unix)]
mod ears;
#[cfg(unix)]
mod files;
#[cfg(unix)]
mod leading;
#[cfg(unix)]
mod phone;
#[cfg_attr(not(unix), allow(dead_code))]
mod reach;
#[cfg(unix)]
mod report;

pub use arguments::Teleop;

use crate::failure::Failure;

/// Runs the command.
#[cfg(unix)]
pub fn run(a: &Teleop) -> Result<(), Failure> {
    if a.print_mapping {
        ::teleop::DEFAULTS.lines().for_each(crate::terminal::write_line);
        return Ok(());
    }
    let source = a.environment().ok_or_else(|| Failure::usage("name an environment"))?;
    drive::drive(a, &source)
}

/// Runs the command.
#[cfg(not(unix))]
pub fn run(_: &Teleop) -> Result<(), Failure> {
    Err(Failure::usage(
        "teleop reads terminals and devices of Linux and macOS; `robohive view` lets a gamepad act",
    ))
}
