//! Recordings that a command line names.

use crate::failure::Failure;
use dataset::trace::TraceReader;
use std::io::Read;
use std::path::Path;

/// Opens a recording; `-` is standard input.
pub fn open(path: &Path) -> Result<TraceReader, Failure> {
    if path.as_os_str() != "-" {
        return TraceReader::open(path).map_err(Failure::usage);
    }
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes).map_err(|e| Failure::usage(format!("standard input: {e}")))?;
    TraceReader::memory("standard input", bytes).map_err(Failure::usage)
}
