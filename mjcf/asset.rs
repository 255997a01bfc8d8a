//! What can go wrong when an asset is decoded or compiled.
//!
//! Decoders see bytes, never files or XML, so the error carries at most a line of the asset's own text: the XML
//! layer adds `file:line:column` of the element that named the asset.
//!
//! ```
//! use robohive_mjcf::{asset::AssetErrorKind, mesh::decode};
//!
//! let error = decode(b"v 0 0 0\nv 1 two 3\n", "chair.obj", "").unwrap_err();
//! assert_eq!((error.kind, error.line), (AssetErrorKind::Malformed, Some(2)));
//! ```

use std::fmt;

use crate::escape::Escaped;

/// Why an asset was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum AssetErrorKind {
    /// The bytes end before the data their header announces.
    Truncated,
    /// The bytes contradict the format.
    Malformed,
    /// A well-formed asset that asks for something this compiler does not do.
    Unsupported,
    /// Array sizes or indices of the asset disagree with each other.
    Inconsistent,
    /// The geometry cannot be used: flat, collinear, zero volume, not finite.
    Geometry,
}

/// A refused asset, with a message meant for the model's author.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct AssetError {
    /// Class of the failure.
    pub kind: AssetErrorKind,
    /// One sentence, without the position of the element that names the asset.
    pub message: String,
    /// Line of the asset's file, from one, where that is text and the line is known.
    pub line: Option<usize>,
}

impl AssetError {
    /// An error of `kind` with `message`.
    pub(crate) fn new(kind: AssetErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into(), line: None }
    }

    /// The same error, on a line of the asset's text.
    pub(crate) fn on_line(self, line: usize) -> Self {
        Self { line: Some(line), ..self }
    }

    pub(crate) fn truncated(message: impl Into<String>) -> Self {
        Self::new(AssetErrorKind::Truncated, message)
    }

    pub(crate) fn malformed(message: impl Into<String>) -> Self {
        Self::new(AssetErrorKind::Malformed, message)
    }

    pub(crate) fn unsupported(message: impl Into<String>) -> Self {
        Self::new(AssetErrorKind::Unsupported, message)
    }

    pub(crate) fn inconsistent(message: impl Into<String>) -> Self {
        Self::new(AssetErrorKind::Inconsistent, message)
    }

    pub(crate) fn geometry(message: impl Into<String>) -> Self {
        Self::new(AssetErrorKind::Geometry, message)
    }
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", Escaped(&self.message))
    }
}

impl std::error::Error for AssetError {}
