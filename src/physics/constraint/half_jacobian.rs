//! `Y = J M^(-1/2)`, from the factor `L'DL` of the inertia: `Y Yᵀ` is the inverse inertia in constraint space.
//!
//! Rows are kept in blocks, so that one pass through the factor serves a whole block; each row keeps its own order
//! of operations.

use crate::inertia::row;
use crate::math::bit_set;
use crate::model::Model;
use crate::stages::{Constraints, Inertia};

/// Rows of a block.
pub const BLOCK: usize = 8;

/// Rows of a tile of `Y Yᵀ`, which is `BLOCK` wide.
pub const TILE: usize = 4;

/// `Y` in blocks of rows; columns that cannot be zero are sets of bits.
#[derive(Clone, Debug, Default)]
pub struct HalfJacobian {
    /// Entries of each block by column.
    entries: Vec<[f64; BLOCK]>,
    /// Words of a set of columns.
    words: usize,
    /// Columns of each block: the columns of `J` and their ancestors.
    blocks: Vec<u64>,
    /// Ancestors of each degree of freedom, and itself.
    ancestors: Vec<u64>,
    /// Reciprocal square root of the factor's diagonal.
    root: Vec<f64>,
    /// Columns and entries of one row.
    set: Vec<u64>,
    values: Vec<f64>,
}

/// Computes `Y`: a row of `J`, completed with the ancestors of its degrees of freedom, is substituted back
/// through the unit factor and scaled by the square root of the diagonal.
pub fn half_jacobian(m: &Model, inertia: &Inertia, efc: &Constraints, y: &mut HalfJacobian) {
    y.root.clear();
    y.root.extend((0..m.nv).map(|dof| 1.0 / inertia.qLD[row(m, dof).end - 1].sqrt()));
    y.find_ancestors(m);
    let count = efc.nefc.div_ceil(BLOCK);
    y.entries.clear();
    y.entries.resize(count * m.nv, [0.0; BLOCK]);
    y.blocks.clear();
    y.blocks.resize(count * y.words, 0);
    for b in 0..count {
        let entries = &mut y.entries[b * m.nv..(b + 1) * m.nv];
        let columns = &mut y.blocks[b * y.words..(b + 1) * y.words];
        for i in b * BLOCK..efc.nefc.min((b + 1) * BLOCK) {
            let (j_columns, values) = jacobian_row(efc, i);
            add_columns(j_columns, &y.ancestors, columns);
            for (&c, &value) in j_columns.iter().zip(values) {
                entries[c as usize][i % BLOCK] = value;
            }
        }
        bit_set::for_each_reversed(columns, |c| substitute(m, inertia, c, y.root[c], entries));
    }
}

/// Columns of row `i` of `J` and their entries.
fn jacobian_row(efc: &Constraints, i: usize) -> (&[i32], &[f64]) {
    let start = efc.efc_J_rowadr[i] as usize;
    let range = start..start + efc.efc_J_rownnz[i] as usize;
    (&efc.efc_J_colind[range.clone()], &efc.efc_J[range])
}

/// Adds columns, increasing, and their ancestors to a set.
fn add_columns(columns: &[i32], ancestors: &[u64], set: &mut [u64]) {
    for &c in columns.iter().rev() {
        let c = c as usize;
        if !bit_set::contains(set, c) {
            bit_set::unite(set, &ancestors[c * set.len()..(c + 1) * set.len()]);
        }
    }
}

/// Takes column `c`, which is complete, out of its ancestors, and scales it.
#[inline]
fn substitute(m: &Model, inertia: &Inertia, c: usize, root: f64, entries: &mut [[f64; BLOCK]]) {
    let (range, value) = (row(m, c), entries[c]);
    let range = range.start..range.end - 1;
    for (&ancestor, l) in m.M_colind[range.clone()].iter().zip(&inertia.qLD[range]) {
        let out = &mut entries[ancestor as usize];
        (0..BLOCK).for_each(|k| out[k] -= l * value[k]);
    }
    entries[c] = value.map(|x| x * root);
}

impl HalfJacobian {
    fn find_ancestors(&mut self, m: &Model) {
        self.words = bit_set::words(m.nv);
        self.ancestors.clear();
        self.ancestors.resize(m.nv * self.words, 0);
        for dof in 0..m.nv {
            let (before, set) = self.ancestors.split_at_mut(dof * self.words);
            if let [.., parent, _] = m.M_colind[row(m, dof)] {
                set[..self.words].copy_from_slice(&before[parent as usize * self.words..][..self.words]);
            }
            bit_set::insert(set, dof);
        }
    }

    /// Words of a set of columns.
    pub fn words(&self) -> usize {
        self.words
    }

    /// Adds the columns of row `i` and of their ancestors to a set.
    pub fn add_columns_of(&self, efc: &Constraints, i: usize, set: &mut [u64]) {
        add_columns(jacobian_row(efc, i).0, &self.ancestors, set);
    }

    /// Entries of row `i`, columns of ancestors included.
    pub fn row(&mut self, efc: &Constraints, i: usize) -> &[f64] {
        let Self { entries, words, ancestors, root, set, values, .. } = self;
        set.clear();
        set.resize(*words, 0);
        add_columns(jacobian_row(efc, i).0, ancestors, set);
        let entries = &entries[i / BLOCK * root.len()..][..root.len()];
        values.clear();
        bit_set::for_each(set, |c| values.push(entries[c][i % BLOCK]));
        values
    }

    /// Products of rows `first..first + TILE`, of one block, with the rows of block `b`, summed in order of columns.
    #[inline]
    pub fn product(&self, first: usize, b: usize) -> [[f64; BLOCK]; TILE] {
        let (nv, words, a) = (self.root.len(), self.words, first / BLOCK);
        let (left, right) = (&self.entries[a * nv..(a + 1) * nv], &self.entries[b * nv..(b + 1) * nv]);
        let (x, y) = (&self.blocks[a * words..(a + 1) * words], &self.blocks[b * words..(b + 1) * words]);
        let mut sum = [[0.0; BLOCK]; TILE];
        bit_set::for_each_common(x, y, |c| {
            let (x, y) = (&left[c][first % BLOCK..][..TILE], &right[c]);
            for r in 0..TILE {
                (0..BLOCK).for_each(|k| sum[r][k] += y[k] * x[r]);
            }
        });
        sum
    }
}
