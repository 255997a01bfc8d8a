//! What can be wrong with an HDF5 file.

use std::fmt;
use std::path::PathBuf;

/// What is wrong with a file, and with which of its objects.
#[derive(Clone, Debug)]
pub struct Hdf5Error {
    /// The file; empty for bytes in memory.
    pub path: PathBuf,
    /// Path of the object inside the file; empty when the file itself is at fault.
    pub object: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Hdf5Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if !self.object.is_empty() {
            write!(f, ", {:?}", self.object)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Hdf5Error {}

/// What a decoder returns: a value, or a sentence about the bytes.
pub(crate) type Decoded<T> = Result<T, String>;
