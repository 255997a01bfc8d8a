//! `compile`: a model as one file that loads in milliseconds.

use crate::failure::{Failure, unwritable};
use crate::input::loading::load;
use crate::input::source::ModelSource;
use crate::output::{check_place, compiled_file, keep_input};
use crate::terminal::show;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Compile a model into one file that loads in milliseconds
#[derive(Args)]
#[command(
    after_help = "The file holds all arrays, meshes and textures included, bit for bit; every command takes it \
as MODEL. A version of robohive with other arrays refuses it: compile the text again.

Examples:
  robohive compile assets/franka/franka_table.xml --out franka.rhm
  robohive sim franka.rhm --seconds 2"
)]
pub struct Compile {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// File to write; replaces it
    #[arg(long, value_name = "FILE.rhm", value_hint = ValueHint::FilePath, value_parser = compiled_file)]
    pub out: PathBuf,
}

/// Runs the command.
pub fn run(a: &Compile) -> Result<(), Failure> {
    check_place(&a.out)?;
    keep_input(&a.model.path, &a.out)?;
    let m = load(&a.model.path, &a.model.reading)?;
    let bytes = m.to_bytes();
    std::fs::write(&a.out, &bytes).map_err(unwritable(&a.out))?;
    show!("{}: {} bytes", a.out.display(), bytes.len());
    Ok(())
}
