//! Why an edit is refused.

use crate::consistency::Inconsistent;
use crate::constants::set_const::SetConstError;
use crate::model::{NotSimulated, PluginError};
use std::fmt;

/// Why an edit was refused. The model is as it was before.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EditError {
    /// A size was changed.
    Size {
        /// Name of the size.
        field: &'static str,
        /// Its value before.
        expected: usize,
        /// The same after the edit.
        found: usize,
    },
    /// A number was replaced by NaN.
    NotANumber {
        /// Name of the array.
        field: &'static str,
        /// Place in it, rows flattened.
        index: usize,
    },
    /// A reference leads to no element, or arrays contradict each other.
    Inconsistent(Inconsistent),
    /// The compiled structure cannot represent the new numbers.
    Structure(SetConstError),
    /// The model now asks for a feature that is not simulated.
    NotSimulated(NotSimulated),
    /// A plugin refuses the new numbers.
    Plugin(PluginError),
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EditError::Size { field, expected, found } => write!(
                f,
                "an edit cannot change sizes: {field} has {found} instead of {expected}; compile another model \
                 for another number of elements"
            ),
            EditError::NotANumber { field, index } => write!(f, "the edit set {field}[{index}] to NaN"),
            EditError::Inconsistent(what) => write!(f, "the edit contradicts the rest of the model: {what}"),
            EditError::Structure(what) => write!(f, "{what}; compile another model"),
            EditError::NotSimulated(what) => write!(f, "{what}"),
            EditError::Plugin(what) => write!(f, "{what}"),
        }
    }
}

impl std::error::Error for EditError {}
