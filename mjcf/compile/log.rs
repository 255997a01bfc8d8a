//! Findings of the compile and what they call elements.

use crate::budget::Budget;
use crate::diagnostic::{Diagnostics, Loc, Sources};

/// Where findings of the compile go, and the memory asked for so far.
pub(super) struct Log<'a> {
    pub sources: &'a Sources,
    pub diagnostics: &'a mut Diagnostics,
    pub budget: Budget,
}

impl Log<'_> {
    pub(super) fn error(&mut self, loc: Loc, message: impl Into<String>) {
        self.diagnostics.error(self.sources, loc, message);
    }

    pub(super) fn error_with(&mut self, loc: Loc, message: impl Into<String>, advice: Option<String>) {
        self.diagnostics.error_with(self.sources, loc, message, advice);
    }

    /// Adds `bytes` that `what` asks for to the budget; false, with an error at `loc`, when they are beyond it.
    pub(super) fn charge(&mut self, loc: Loc, what: &str, bytes: usize) -> bool {
        self.budget.charge(self.sources, self.diagnostics, loc, (what, bytes))
    }

    /// The value, or its error reported for the element called `what`.
    pub(super) fn check<T>(&mut self, loc: Loc, what: &str, result: Result<T, String>) -> Option<T> {
        result.map_err(|message| self.error(loc, format!("{what}: {message}"))).ok()
    }
}

/// `kind 'name'`, or the kind alone for a nameless element.
pub(super) fn title(kind: &str, name: &str) -> String {
    if name.is_empty() { kind.to_owned() } else { format!("{kind} '{name}'") }
}
