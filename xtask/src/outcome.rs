//! What comes of a check.

/// Something that this machine cannot check.
pub struct Missing {
    /// What is not checked, and what the machine lacks for it.
    pub what: String,
    /// How to get what is missing.
    pub get: String,
}

impl Missing {
    /// Not checked: `what`; to get it: `get`.
    pub fn new(what: impl Into<String>, get: impl Into<String>) -> Self {
        Missing { what: what.into(), get: get.into() }
    }
}

/// The parts of a check that this machine could not run; an error where a part failed.
pub type Outcome = Result<Vec<Missing>, String>;
