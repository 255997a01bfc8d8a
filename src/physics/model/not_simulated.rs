//! A feature that the engine does not simulate, and the element that asks for it.

use std::fmt;

/// A feature that the engine does not simulate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotSimulated {
    /// The feature, as a noun phrase.
    pub feature: String,
    /// The element that asks for it; `None` for an option or a call.
    pub element: Option<String>,
}

impl NotSimulated {
    /// A feature that an option or a call asks for.
    pub(crate) fn feature(feature: &str) -> Self {
        NotSimulated { feature: feature.into(), element: None }
    }

    /// A feature that an element asks for; `label` names the element with its kind.
    pub(crate) fn of(label: String, feature: &str) -> Self {
        NotSimulated { feature: feature.into(), element: Some(label) }
    }
}

impl fmt::Display for NotSimulated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.element {
            Some(element) => {
                write!(f, "{element} asks for {}, which this version does not simulate", self.feature)
            }
            None => write!(f, "this version does not simulate {}", self.feature),
        }
    }
}

impl std::error::Error for NotSimulated {}
