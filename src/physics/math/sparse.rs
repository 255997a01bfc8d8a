//! Rows of compressed matrices against dense vectors; symmetric products, the L'DL solve and LU.

use std::ops::Range;

/// Inner product of a sparse row (`values` at `columns`) with dense `x`, summed in four lanes.
#[inline]
pub fn dot_sparse(values: &[f64], columns: &[i32], x: &[f64]) -> f64 {
    let (v4, v_rest) = values.as_chunks::<4>();
    let (c4, c_rest) = columns.as_chunks::<4>();
    let mut lane = [0.0; 4];
    for (v, c) in v4.iter().zip(c4) {
        for i in 0..4 {
            lane[i] += v[i] * x[c[i] as usize];
        }
    }
    let mut sum = (lane[0] + lane[2]) + (lane[1] + lane[3]);
    for (v, c) in v_rest.iter().zip(c_rest) {
        sum += v * x[*c as usize];
    }
    sum
}

/// `x[columns] += s values`.
pub fn scatter_scaled(values: &[f64], columns: &[i32], s: f64, x: &mut [f64]) {
    for (v, c) in values.iter().zip(columns) {
        x[*c as usize] += v * s;
    }
}

/// `y += s x`.
#[inline]
pub fn add_scaled_slice(y: &mut [f64], x: &[f64], s: f64) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// Structure of a symmetric matrix. Its lower triangle is stored in compressed rows, diagonal last.
#[derive(Clone, Copy, Debug)]
pub struct LowerRows<'a> {
    /// Non-zeros of each row.
    pub rownnz: &'a [i32],
    /// Start of each row.
    pub rowadr: &'a [i32],
    /// Columns, increasing within a row.
    pub colind: &'a [i32],
}

impl LowerRows<'_> {
    /// Start of row `i` and the place of its diagonal.
    #[inline]
    fn span(&self, i: usize) -> (usize, usize) {
        let start = self.rowadr[i] as usize;
        (start, start + self.rownnz[i] as usize - 1)
    }

    /// `out = (A + strict upper Aᵀ) v`.
    pub fn mul_symmetric(&self, a: &[f64], v: &[f64], out: &mut [f64]) {
        for i in 0..out.len() {
            let (start, diagonal) = self.span(i);
            let (mut sum, vi) = (a[diagonal] * v[i], v[i]);
            for (&j, a) in self.colind[start..diagonal].iter().zip(&a[start..diagonal]).rev() {
                let j = j as usize;
                sum += a * v[j];
                out[j] += a * vi;
            }
            out[i] = sum;
        }
    }

    /// The same where `coupled` lists the rows that have more than the diagonal, which is also given by itself.
    pub fn mul_coupled(&self, a: &[f64], diagonal: &[f64], coupled: &[u32], v: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(diagonal).zip(v).for_each(|((out, d), v)| *out = d * v);
        for &i in coupled {
            let i = i as usize;
            let ((start, end), vi) = (self.span(i), v[i]);
            let mut sum = out[i];
            for (&j, a) in self.colind[start..end].iter().zip(&a[start..end]).rev() {
                let j = j as usize;
                sum += a * v[j];
                out[j] += a * vi;
            }
            out[i] = sum;
        }
    }

    /// Solves `Lᵀ D L x = x` in place with unit `L` and the reciprocal diagonal of `D`
    /// (Featherstone 2008, section 6.5).
    pub fn solve_ldl(&self, ld: &[f64], inverse_diagonal: &[f64], x: &mut [f64]) {
        self.solve_ldl_rows(ld, inverse_diagonal, 0..x.len(), x);
    }

    /// The same for `rows` that no other row shares a non-zero with.
    pub fn solve_ldl_rows(&self, ld: &[f64], inverse_diagonal: &[f64], rows: Range<usize>, x: &mut [f64]) {
        self.solve_transposed_rows(ld, rows.clone(), x);
        for (x, d) in x[rows.clone()].iter_mut().zip(&inverse_diagonal[rows.clone()]) {
            *x *= d;
        }
        self.solve_unit_rows(ld, rows, x);
    }

    /// The same for all rows, where `coupled` lists those that have more than the diagonal.
    pub fn solve_ldl_coupled(&self, ld: &[f64], inverse_diagonal: &[f64], coupled: &[u32], x: &mut [f64]) {
        let coupled = coupled.iter().map(|&i| i as usize);
        self.solve_transposed_rows(ld, coupled.clone(), x);
        x.iter_mut().zip(inverse_diagonal).for_each(|(x, d)| *x *= d);
        self.solve_unit_rows(ld, coupled, x);
    }

    /// Solves `L x = x` in place with unit `L`.
    #[inline]
    fn solve_unit_rows(&self, ld: &[f64], rows: impl Iterator<Item = usize>, x: &mut [f64]) {
        for i in rows {
            let (start, diagonal) = self.span(i);
            x[i] -= dot_sparse(&ld[start..diagonal], &self.colind[start..diagonal], x);
        }
    }

    /// Solves `Lᵀ x = x` in place with unit `L`.
    pub fn solve_transposed(&self, ld: &[f64], x: &mut [f64]) {
        self.solve_transposed_rows(ld, 0..x.len(), x);
    }

    #[inline]
    fn solve_transposed_rows(&self, ld: &[f64], rows: impl DoubleEndedIterator<Item = usize>, x: &mut [f64]) {
        for i in rows.rev() {
            let (start, diagonal) = self.span(i);
            if x[i] != 0.0 {
                scatter_scaled(&ld[start..diagonal], &self.colind[start..diagonal], -x[i], x);
            }
        }
    }
}

/// Structure of a matrix in compressed rows whose pattern is symmetric and fills in nowhere when the last rows are
/// eliminated first, as pairs of nodes on one chain of a tree.
#[derive(Clone, Copy, Debug)]
pub struct FullRows<'a> {
    /// Non-zeros of each row.
    pub rownnz: &'a [i32],
    /// Start of each row.
    pub rowadr: &'a [i32],
    /// Place of the diagonal within each row.
    pub diagonal: &'a [i32],
    /// Columns, increasing within a row.
    pub colind: &'a [i32],
}

impl FullRows<'_> {
    /// Replaces `A` by `L` and `U` with `A = (U + 1) L`: `L` below and on the diagonal, `U` above. `remaining` is
    /// working memory.
    pub fn factor_lu(&self, a: &mut [f64], remaining: &mut Vec<usize>) {
        let n = self.rownnz.len();
        remaining.clear();
        remaining.extend(self.rownnz.iter().map(|&k| k as usize));
        for i in (0..n).rev() {
            let (start, diagonal) = (self.rowadr[i] as usize, self.diagonal[i] as usize);
            // Rows below are done, so the diagonal comes last.
            let (above, row_i) = a.split_at_mut(start);
            let (row_i, pivot) = (&row_i[..diagonal], row_i[diagonal]);
            let columns_i = &self.colind[start..start + diagonal];
            for &j in columns_i {
                let j = j as usize;
                remaining[j] -= 1;
                let at = self.rowadr[j] as usize;
                let row_j = &mut above[at..=at + remaining[j]];
                let factor = row_j[remaining[j]] / pivot;
                row_j[remaining[j]] = factor;
                let mut k = 0;
                for (&value, &column) in row_i.iter().zip(columns_i) {
                    while self.colind[at + k] != column {
                        k += 1;
                    }
                    row_j[k] -= value * factor;
                }
            }
        }
    }

    /// `x <- A^-1 x` with the factors that `factor_lu` left in `lu`.
    pub fn solve_lu(&self, lu: &[f64], x: &mut [f64]) {
        let n = self.rownnz.len();
        for i in (0..n).rev() {
            let (start, diagonal) = (self.rowadr[i] as usize, self.diagonal[i] as usize);
            let above = start + diagonal + 1..start + self.rownnz[i] as usize;
            x[i] -= dot_sparse(&lu[above.clone()], &self.colind[above], x);
        }
        for i in 0..n {
            let (start, diagonal) = (self.rowadr[i] as usize, self.diagonal[i] as usize);
            let below = start..start + diagonal;
            x[i] -= dot_sparse(&lu[below.clone()], &self.colind[below], x);
            x[i] /= lu[start + diagonal];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// L'DL of [\[4, 2, 1\], \[2, 5, 2\], [1, 2, 3]] by hand: D = (d0, 11/3, 3), L rows (1), (l10, 1), (1/3, 2/3, 1).
    #[test]
    fn solve_inverts_product() {
        let rows = LowerRows { rownnz: &[1, 2, 3], rowadr: &[0, 1, 3], colind: &[0, 0, 1, 0, 1, 2] };
        let a = [4.0, 2.0, 5.0, 1.0, 2.0, 3.0];
        let (d2, l20, l21) = (3.0, 1.0 / 3.0, 2.0 / 3.0);
        let d1 = 5.0 - l21 * l21 * d2;
        let l10 = (2.0 - l21 * l20 * d2) / d1;
        let d0 = 4.0 - l20 * l20 * d2 - l10 * l10 * d1;
        let ld = [d0, l10, d1, l20, l21, d2];
        let v = [1.0, -2.0, 0.5];
        let mut x = [0.0; 3];
        rows.mul_symmetric(&a, &v, &mut x);
        assert_eq!(x, [0.5, -7.0, -1.5]);
        rows.solve_ldl(&ld, &[1.0 / d0, 1.0 / d1, 1.0 / d2], &mut x);
        for (x, v) in x.iter().zip(v) {
            assert!((x - v).abs() < 1e-14);
        }
    }

    /// Nodes 1 and 2 hang from node 0 and do not meet: [\[5, 1, 2\], \[3, 4, 0\], [-1, 0, 6]].
    #[test]
    fn lu_solves_an_unsymmetric_system() {
        let rows = FullRows {
            rownnz: &[3, 2, 2],
            rowadr: &[0, 3, 5],
            diagonal: &[0, 1, 1],
            colind: &[0, 1, 2, 0, 1, 0, 2],
        };
        let mut a = [5.0, 1.0, 2.0, 3.0, 4.0, -1.0, 6.0];
        rows.factor_lu(&mut a, &mut Vec::new());
        let mut x = [5.0 - 2.0 + 6.0, 3.0 - 8.0, -1.0 + 18.0];
        rows.solve_lu(&a, &mut x);
        for (x, v) in x.iter().zip([1.0, -2.0, 3.0]) {
            assert!((x - v).abs() < 1e-14);
        }
    }
}
