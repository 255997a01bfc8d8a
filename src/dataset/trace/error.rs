//! What can go wrong with a recording.

use crate::hdf5::error::Hdf5Error;
use crate::npz::NpzError;
use std::fmt;
use std::path::{Path, PathBuf};

/// What went wrong with a recording, and where in it.
#[derive(Clone, Debug)]
pub struct TraceError {
    /// The file; empty for bytes in memory.
    pub path: PathBuf,
    /// Trial, or trial and key, as in `Trial0/env_infos/solved`; empty when the file itself is at fault.
    pub object: String,
    /// What is wrong.
    pub message: String,
}

impl TraceError {
    /// An error about an object of a file.
    pub fn new(path: &Path, object: impl Into<String>, message: impl fmt::Display) -> Self {
        TraceError { path: path.to_owned(), object: object.into(), message: message.to_string() }
    }
}

impl fmt::Display for TraceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if !self.object.is_empty() {
            write!(f, ", {:?}", self.object)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for TraceError {}

impl From<Hdf5Error> for TraceError {
    fn from(Hdf5Error { path, object, message }: Hdf5Error) -> Self {
        TraceError { path, object, message }
    }
}

impl From<NpzError> for TraceError {
    fn from(NpzError { path, member, message }: NpzError) -> Self {
        TraceError { path, object: member, message }
    }
}
