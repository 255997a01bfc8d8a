//! Methods that find no solution.

use std::fmt;

/// A method found no solution: which one, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSolution {
    /// The method.
    pub method: &'static str,
    /// Why it found none.
    pub message: String,
}

impl NoSolution {
    /// No solution by `method`, because of what the message says.
    pub fn new(method: &'static str, message: impl Into<String>) -> Self {
        NoSolution { method, message: message.into() }
    }
}

impl fmt::Display for NoSolution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.method, self.message)
    }
}

impl std::error::Error for NoSolution {}
