//! What is wrong with a pickle.

use std::fmt;

/// What is wrong with a pickle, or with what it holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PickleError {
    /// The byte at which reading stopped, where the pickle itself is malformed.
    pub offset: Option<usize>,
    /// A sentence.
    pub message: String,
}

impl PickleError {
    pub(super) fn at(offset: usize, message: impl Into<String>) -> Self {
        PickleError { offset: Some(offset), message: message.into() }
    }

    pub(super) fn content(message: impl Into<String>) -> Self {
        PickleError { offset: None, message: message.into() }
    }
}

impl fmt::Display for PickleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.offset {
            Some(offset) => write!(f, "byte {offset} of the pickle: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl std::error::Error for PickleError {}
