//! Rows of compressed matrices against dense vectors; symmetric products and the L'DL solve.

/// Inner product of a sparse row (`values` at `columns`) with dense `x`, summed in four lanes.
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
pub fn add_scaled_slice(y: &mut [f64], x: &[f64], s: f64) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// Structure of a symmetric matrix of which the lower triangle is stored in compressed rows, diagonal last.
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
            for k in (start..diagonal).rev() {
                let j = self.colind[k] as usize;
                sum += a[k] * v[j];
                out[j] += a[k] * vi;
            }
            out[i] = sum;
        }
    }

    /// Solves `Lᵀ D L x = x` in place with unit `L` and the reciprocal diagonal of `D`
    /// (Featherstone 2008, section 6.5).
    pub fn solve_ldl(&self, ld: &[f64], inverse_diagonal: &[f64], x: &mut [f64]) {
        self.solve_transposed(ld, x);
        for (x, d) in x.iter_mut().zip(inverse_diagonal) {
            *x *= d;
        }
        for i in 0..x.len() {
            let (start, diagonal) = self.span(i);
            x[i] -= dot_sparse(&ld[start..diagonal], &self.colind[start..diagonal], x);
        }
    }

    /// Solves `Lᵀ x = x` in place with unit `L`.
    pub fn solve_transposed(&self, ld: &[f64], x: &mut [f64]) {
        for i in (0..x.len()).rev() {
            let (start, diagonal) = self.span(i);
            if x[i] != 0.0 {
                scatter_scaled(&ld[start..diagonal], &self.colind[start..diagonal], -x[i], x);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// L'DL of [[4, 2, 1], [2, 5, 2], [1, 2, 3]] by hand: D = (d0, 11/3, 3), L rows (1), (l10, 1), (1/3, 2/3, 1).
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
}
