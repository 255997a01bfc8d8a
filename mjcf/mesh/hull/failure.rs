//! Why a hull cannot be made.

/// A numerical accident the construction cannot continue from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Failure(pub &'static str);
