//! `compile`: a model as one file that loads in milliseconds.

use crate::arguments::Compile;
use crate::loading::load;
use crate::terminal::show;
use crate::{Failure, unwritable};

/// Runs the command.
pub fn run(a: &Compile) -> Result<(), Failure> {
    let m = load(&a.model.path, &a.model.reading)?;
    let bytes = m.to_bytes();
    std::fs::write(&a.out, &bytes).map_err(unwritable(&a.out))?;
    show!("{}: {} bytes", a.out.display(), bytes.len());
    Ok(())
}
