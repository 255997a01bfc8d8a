//! What all ids have in common.

use crate::model::{Arrays, Model, ObjType};
use std::ops::Range;

/// An id of one kind of element.
pub trait Element: Copy {
    /// The kind.
    const KIND: ObjType;
    /// Number of such elements in a model.
    fn count(m: &Arrays) -> usize;
    /// The element at `index` in the arrays of its kind, which must exist.
    fn of(m: &Model, index: usize) -> Self;
    /// Place in the arrays of its kind.
    fn index(self) -> usize;
    /// Checks that the id was found in a model of the structure of `m`.
    ///
    /// # Panics
    /// In debug builds: it was not.
    fn check_model(self, m: &Model);
    /// The element at `index` in the arrays of its kind; `None` beyond the last.
    fn at(m: &Model, index: usize) -> Option<Self> {
        (index < Self::count(m)).then(|| Self::of(m, index))
    }
}

/// Where the numbers of an element stand in an array.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Span {
    start: u32,
    len: u32,
}

impl Span {
    /// `len` numbers from an address, -1 for none.
    pub fn new(start: i32, len: i32) -> Self {
        Span { start: start.max(0) as u32, len: len.max(0) as u32 }
    }

    pub fn range(self) -> Range<usize> {
        self.start as usize..(self.start + self.len) as usize
    }
}
