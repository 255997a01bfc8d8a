//! Where the entries of an island's Jacobian and inertia are.

/// Which entries compressed rows and the inertia have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pattern {
    /// Start of each compressed row, and the end of the last.
    pub row_start: Vec<usize>,
    /// Columns of compressed rows.
    pub columns: Vec<i32>,
    /// Non-zeros of each inertia row.
    pub inertia_rownnz: Vec<i32>,
    /// Start of each inertia row.
    pub inertia_rowadr: Vec<i32>,
    /// Columns of the inertia.
    pub inertia_colind: Vec<i32>,
}

impl Pattern {
    pub fn clear(&mut self) {
        self.row_start.clear();
        self.columns.clear();
        self.inertia_rownnz.clear();
        self.inertia_rowadr.clear();
        self.inertia_colind.clear();
    }

    /// Makes room for as much as `other` has, so that exchanging the two needs no more memory.
    pub fn make_room(&mut self, other: &Pattern) {
        let room = |own: usize, other: usize| other.saturating_sub(own);
        self.row_start.reserve(room(self.row_start.len(), other.row_start.len()));
        self.columns.reserve(room(self.columns.len(), other.columns.len()));
        self.inertia_rownnz.reserve(room(self.inertia_rownnz.len(), other.inertia_rownnz.len()));
        self.inertia_rowadr.reserve(room(self.inertia_rowadr.len(), other.inertia_rowadr.len()));
        self.inertia_colind.reserve(room(self.inertia_colind.len(), other.inertia_colind.len()));
    }
}
