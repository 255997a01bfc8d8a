//! What loading and compiling yield.

use physics::Model;

use crate::diagnostic::Diagnostics;

/// A model ready for physics.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The model.
    pub model: Model,
    /// What was ignored or assumed; no errors.
    pub warnings: Diagnostics,
}
