//! What can go wrong when an asset is decoded or compiled.
//!
//! Decoders see bytes, never files or XML, so the error carries no position: the XML layer adds
//! `file:line:column` of the element that named the asset.

use std::fmt;

/// Why an asset was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
pub struct AssetError {
    /// Class of the failure.
    pub kind: AssetErrorKind,
    /// One sentence, without position.
    pub message: String,
}

impl AssetError {
    /// An error of `kind` with `message`.
    pub fn new(kind: AssetErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
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
        f.write_str(&self.message)
    }
}

impl std::error::Error for AssetError {}
