//! Sets of arrays.

use crate::arrays::{ArrayId, Arrays};

/// The arrays that an edit wrote.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Written {
    bits: [u64; ArrayId::ALL.len().div_ceil(64)],
}

impl Written {
    /// The arrays that the edit under way wrote.
    pub(super) fn of(m: &Arrays) -> Self {
        let mut written = Written::default();
        m.visit_written_ids(&mut |array| written.insert(array));
        written
    }

    fn insert(&mut self, array: ArrayId) {
        self.bits[array as usize / 64] |= 1 << (array as usize % 64);
    }

    /// The array is among them.
    pub(crate) fn has(&self, array: ArrayId) -> bool {
        self.bits[array as usize / 64] >> (array as usize % 64) & 1 == 1
    }

    /// All of them, in declaration order.
    pub(super) fn iter(self) -> impl Iterator<Item = ArrayId> {
        ArrayId::ALL.iter().copied().filter(move |&array| self.has(array))
    }
}
