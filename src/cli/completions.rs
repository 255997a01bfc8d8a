//! `completions`: what a shell completes.

use crate::Failure;
use crate::arguments::{Arguments, Completions};
use crate::terminal::write_bytes;
use clap::CommandFactory;

/// Runs the command.
pub fn run(a: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut Arguments::command(), "robohive", &mut script);
    write_bytes(&script);
    Ok(())
}
