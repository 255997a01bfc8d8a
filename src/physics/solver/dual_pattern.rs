//! Which entries of `A = Y Yᵀ` can differ from zero: entries of two rows that share a column of `Y`.

use crate::constraint::HalfJacobian;
use crate::stages::Constraints;
use std::ops::Range;

/// Columns of each row, increasing, as compressed rows have them.
#[derive(Clone, Debug, Default)]
pub(super) struct Pattern {
    columns: Vec<i32>,
    /// Where the columns of each row are; the same for rows of one contact.
    spans: Vec<Range<usize>>,
    /// Columns of `Y` of each row.
    sets: Vec<u64>,
    /// Successive rows with the same.
    groups: Vec<Range<usize>>,
}

impl Pattern {
    /// Finds the pattern of the rows whose `Y` was computed. Rows that move nothing keep all columns, so that each has its
    /// diagonal.
    pub fn find(&mut self, half: &HalfJacobian, efc: &Constraints) {
        let words = half.words().max(1);
        let Pattern { columns, spans, sets, groups } = self;
        sets.clear();
        sets.resize(efc.nefc * words, 0);
        for (i, set) in sets.chunks_exact_mut(words).enumerate() {
            half.add_columns_of(efc, i, set);
        }
        let set = |i: usize| &sets[i * words..(i + 1) * words];
        groups.clear();
        for i in 0..efc.nefc {
            match groups.last_mut() {
                Some(group) if set(group.start) == set(i) => group.end += 1,
                _ => groups.push(i..i + 1),
            }
        }
        columns.clear();
        spans.clear();
        for group in groups.iter() {
            let (own, first) = (set(group.start), columns.len());
            let empty = own.iter().all(|&word| word == 0);
            let shares = |other: &[u64]| empty || own.iter().zip(other).any(|(x, y)| x & y != 0);
            for other in groups.iter().filter(|other| shares(set(other.start))) {
                columns.extend(other.clone().map(|j| j as i32));
            }
            spans.resize(group.end, first..columns.len());
        }
    }

    /// Columns of row `i`.
    #[inline]
    pub fn columns(&self, i: usize) -> &[i32] {
        &self.columns[self.spans[i].clone()]
    }

    /// Where column `j` stands among the columns of row `i`.
    #[inline]
    pub fn place(&self, i: usize, j: usize) -> usize {
        self.columns(i).partition_point(|&column| (column as usize) < j)
    }
}
