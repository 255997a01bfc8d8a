//! The part of a constraint problem that one island holds: its degrees of freedom, its rows, and the blocks of the
//! inertia and the Jacobian that belong to them, renumbered from zero.

use super::pattern::Pattern;
use super::products::{Columns, Lanes};
use super::rows::Rows;
use crate::math::dense::dot_slice;
use crate::math::{LowerRows, add_scaled_slice, dot_sparse};
use crate::model::{Model, Solver};
use crate::stages::{Constraints, Contacts, Inertia};
use std::ops::Range;

/// Inertia, Jacobian and row parameters of an island, or of the whole model.
#[derive(Clone, Debug, Default)]
pub(super) struct Problem {
    /// Degrees of freedom.
    pub nv: usize,
    /// Row parameters.
    pub rows: Rows,
    /// The Jacobian is stored in full rows.
    pub dense: bool,
    /// Jacobian: full rows, or entries of compressed rows.
    pub jacobian: Vec<f64>,
    /// From the first to the last entry of each full row that is not zero.
    pub spans: Vec<Range<usize>>,
    /// Where the entries are.
    pub pattern: Pattern,
    /// Where the entries of the previous problem were.
    before: Pattern,
    /// How often the pattern has changed; what follows from a pattern is kept while this stays.
    pub changes: u64,
    /// The solver multiplies often, so that columns are put together.
    by_columns: bool,
    /// How products with the transposed compressed rows are added up, by rows or by columns, each with the value that
    /// `changes` had when it was laid out.
    lanes: (u64, Lanes),
    columns: (u64, Columns),
    /// Rows of the inertia that have more than the diagonal.
    coupled: Vec<u32>,
    /// Diagonal of the inertia.
    diagonal: Vec<f64>,
    /// Inertia, lower triangle.
    pub inertia: Vec<f64>,
    /// Its L'DL factor.
    factor: Vec<f64>,
    /// Reciprocal of D.
    inverse_diagonal: Vec<f64>,
}

/// Selection of an island: its degrees of freedom and rows, and the sorted index of every degree of freedom.
#[derive(Clone, Copy)]
pub(super) struct Selection<'a> {
    pub dofs: &'a [i32],
    pub rows: &'a [i32],
    /// Sorted index of each degree of freedom of the model.
    pub sorted: &'a [i32],
    /// Sorted index of the first degree of freedom selected.
    pub first: i32,
}

impl Problem {
    /// Extracts the selected part.
    pub fn gather(&mut self, m: &Model, inertia: &Inertia, efc: &Constraints, con: &Contacts, s: Selection) {
        self.nv = s.dofs.len();
        self.dense = !m.is_sparse();
        self.by_columns = m.opt.solver == Solver::Cg;
        self.rows.gather(efc, &con.contact, s.rows);
        // The one before is compared with sparse rows alone; dense ones need one buffer, which grows once.
        if !self.dense {
            std::mem::swap(&mut self.pattern, &mut self.before);
        }
        self.pattern.clear();
        self.gather_inertia(m, inertia, s);
        if self.dense {
            self.gather_dense(efc, s);
        } else {
            self.gather_sparse(efc, s);
        }
    }

    fn gather_inertia(&mut self, m: &Model, inertia: &Inertia, s: Selection) {
        let pattern = &mut self.pattern;
        self.inertia.clear();
        self.factor.clear();
        self.inverse_diagonal.clear();
        for run in s.dofs.chunk_by(|a, b| a + 1 == *b) {
            let (first, end) = (run[0] as usize, run[0] as usize + run.len());
            let entries = m.M_rowadr[first] as usize..(m.M_rowadr[end - 1] + m.M_rownnz[end - 1]) as usize;
            let shift = self.inertia.len() as i32 - m.M_rowadr[first];
            pattern.inertia_rownnz.extend_from_slice(&m.M_rownnz[first..end]);
            pattern.inertia_rowadr.extend(m.M_rowadr[first..end].iter().map(|adr| adr + shift));
            pattern
                .inertia_colind
                .extend(m.M_colind[entries.clone()].iter().map(|&c| s.sorted[c as usize] - s.first));
            self.inertia.extend_from_slice(&inertia.M[entries.clone()]);
            self.factor.extend_from_slice(&inertia.qLD[entries]);
            self.inverse_diagonal.extend_from_slice(&inertia.qLDiagInv[first..end]);
        }
    }

    /// Appends an inertia row with consecutive columns from `first` to the diagonal.
    #[cfg(test)]
    pub fn push_inertia_row(&mut self, first: i32, row: &[f64]) {
        self.pattern.inertia_rownnz.push(row.len() as i32);
        self.pattern.inertia_rowadr.push(self.inertia.len() as i32);
        self.pattern.inertia_colind.extend(first..first + row.len() as i32);
        self.inertia.extend_from_slice(row);
    }

    fn gather_dense(&mut self, efc: &Constraints, s: Selection) {
        self.jacobian.clear();
        self.jacobian.resize(s.rows.len() * self.nv, 0.0);
        self.spans.clear();
        for (out, &row) in self.jacobian.chunks_exact_mut(self.nv).zip(s.rows) {
            let start = efc.efc_J_rowadr[row as usize] as usize;
            let mut span = self.nv..0;
            for k in start..start + efc.efc_J_rownnz[row as usize] as usize {
                // A tendon's structural zeros may stand in columns of another island.
                if efc.efc_J[k] != 0.0 {
                    let c = (s.sorted[efc.efc_J_colind[k] as usize] - s.first) as usize;
                    out[c] = efc.efc_J[k];
                    span = span.start.min(c)..span.end.max(c + 1);
                }
            }
            self.spans.push(if span.is_empty() { 0..0 } else { span });
        }
    }

    /// Lists the rows of the inertia with more than the diagonal.
    fn find_coupled(&mut self) {
        let Problem { pattern, inertia, coupled, diagonal, .. } = self;
        coupled.clear();
        diagonal.clear();
        for (i, (&adr, &count)) in pattern.inertia_rowadr.iter().zip(&pattern.inertia_rownnz).enumerate() {
            diagonal.push(inertia[(adr + count - 1) as usize]);
            if count > 1 {
                coupled.push(i as u32);
            }
        }
    }

    fn gather_sparse(&mut self, efc: &Constraints, s: Selection) {
        self.find_coupled();
        let pattern = &mut self.pattern;
        self.jacobian.clear();
        pattern.row_start.push(0);
        for &row in s.rows {
            let start = efc.efc_J_rowadr[row as usize] as usize;
            let range = start..start + efc.efc_J_rownnz[row as usize] as usize;
            pattern
                .columns
                .extend(efc.efc_J_colind[range.clone()].iter().map(|&c| s.sorted[c as usize] - s.first));
            self.jacobian.extend_from_slice(&efc.efc_J[range]);
            pattern.row_start.push(self.jacobian.len());
        }
        if self.pattern != self.before {
            self.changes += 1;
            self.before.make_room(&self.pattern);
        }
        if self.by_columns {
            let (of, columns) = &mut self.columns;
            if *of != self.changes {
                *of = self.changes;
                columns.place(self.nv, &self.pattern);
            }
            columns.fill(&self.jacobian);
        } else if self.lanes.0 != self.changes {
            self.lanes.0 = self.changes;
            self.lanes.1.place(self.nv, &self.pattern.columns);
        }
    }

    /// The inertia's structure.
    pub fn inertia_rows(&self) -> LowerRows<'_> {
        LowerRows {
            rownnz: &self.pattern.inertia_rownnz,
            rowadr: &self.pattern.inertia_rowadr,
            colind: &self.pattern.inertia_colind,
        }
    }

    /// Columns and entries of inertia row `i`, diagonal last.
    pub fn inertia_row(&self, i: usize) -> (&[i32], &[f64]) {
        let start = self.pattern.inertia_rowadr[i] as usize;
        let range = start..start + self.pattern.inertia_rownnz[i] as usize;
        (&self.pattern.inertia_colind[range.clone()], &self.inertia[range])
    }

    /// Full row `i`.
    #[inline]
    pub fn dense_row(&self, i: usize) -> &[f64] {
        &self.jacobian[i * self.nv..(i + 1) * self.nv]
    }

    /// Columns and entries of compressed row `i`.
    #[inline]
    pub fn sparse_row(&self, i: usize) -> (&[i32], &[f64]) {
        let range = self.pattern.row_start[i]..self.pattern.row_start[i + 1];
        (&self.pattern.columns[range.clone()], &self.jacobian[range])
    }

    /// `out = J v`.
    pub fn mul_jacobian(&self, v: &[f64], out: &mut [f64]) {
        if self.dense {
            let whole = self.nv / 4 * 4;
            for ((row, span), out) in self.jacobian.chunks_exact(self.nv).zip(&self.spans).zip(out) {
                // The order of additions of full rows: four lanes by column, then the columns that remain.
                let lanes = (span.start / 4 * 4).min(whole)..span.end.next_multiple_of(4).min(whole);
                *out = dot_slice(&row[lanes.clone()], &v[lanes]) + dot_slice(&row[whole..], &v[whole..]);
            }
        } else if self.by_columns {
            self.columns.1.mul(&self.pattern, &self.jacobian, v, out);
        } else {
            for (i, out) in out.iter_mut().enumerate() {
                let (columns, values) = self.sparse_row(i);
                *out = dot_sparse(values, columns, v);
            }
        }
    }

    /// `out = Jᵀ f`: full rows are added one after the other, compressed ones column by column in lanes.
    pub fn mul_jacobian_transposed(&mut self, f: &[f64], out: &mut [f64]) {
        if self.by_columns && !self.dense {
            self.columns.1.mul_transposed(f, out);
        } else if !self.dense {
            self.lanes.1.mul_transposed(&self.pattern.row_start, &self.jacobian, f, out);
        } else {
            out.fill(0.0);
            for (i, &f) in f.iter().enumerate().filter(|(_, f)| **f != 0.0) {
                let span = self.spans[i].clone();
                add_scaled_slice(&mut out[span.clone()], &self.dense_row(i)[span], f);
            }
        }
    }

    /// `out = M v`.
    pub fn mul_inertia(&self, v: &[f64], out: &mut [f64]) {
        let rows = self.inertia_rows();
        if self.dense {
            rows.mul_symmetric(&self.inertia, v, out);
        } else {
            rows.mul_coupled(&self.inertia, &self.diagonal, &self.coupled, v, out);
        }
    }

    /// Solves `M x = x` in place.
    pub fn solve_inertia(&self, x: &mut [f64]) {
        let (rows, inverse) = (self.inertia_rows(), &self.inverse_diagonal);
        if self.dense {
            rows.solve_ldl(&self.factor, inverse, x);
        } else {
            rows.solve_ldl_coupled(&self.factor, inverse, &self.coupled, x);
        }
    }

    /// Sum of the diagonal of `M`.
    pub fn inertia_trace(&self) -> f64 {
        let diagonal = |i: usize| {
            self.inertia[(self.pattern.inertia_rowadr[i] + self.pattern.inertia_rownnz[i] - 1) as usize]
        };
        (0..self.nv).map(diagonal).sum()
    }
}
