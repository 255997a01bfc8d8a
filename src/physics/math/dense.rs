//! Dense vectors and small dense matrices (row-major slices).
//!
//! Inner products keep four running sums, so that the compiler can use vector registers and the order of
//! additions is the same on every target: lanes 0..3 by index modulo 4, then the remainder.

use crate::math::MINVAL;

/// Inner product.
#[inline]
pub fn dot_slice(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (&a[..n], &b[..n]);
    let (mut s, whole) = ([0.0; 4], n & !3);
    for (x, y) in a[..whole].chunks_exact(4).zip(b[..whole].chunks_exact(4)) {
        for k in 0..4 {
            s[k] += x[k] * y[k];
        }
    }
    let sum = (s[0] + s[2]) + (s[1] + s[3]);
    let (a, b) = (&a[whole..], &b[whole..]);
    match a.len() {
        3 => sum + (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]),
        2 => sum + (a[0] * b[0] + a[1] * b[1]),
        1 => sum + a[0] * b[0],
        _ => sum,
    }
}

/// Euclidean length.
pub fn norm_slice(a: &[f64]) -> f64 {
    dot_slice(a, a).sqrt()
}

/// Solution of `A x = b` by elimination with the largest pivot of each column; `None` when one is below `MINVAL`.
pub fn solve_lu<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let mut largest = k;
        for i in k + 1..N {
            if a[i][k].abs() > a[largest][k].abs() {
                largest = i;
            }
        }
        if a[largest][k].abs() < MINVAL {
            return None;
        }
        a.swap(k, largest);
        b.swap(k, largest);
        let inverse = 1.0 / a[k][k];
        for i in k + 1..N {
            let factor = a[i][k] * inverse;
            for j in k + 1..N {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for i in (0..N).rev() {
        for j in i + 1..N {
            b[i] -= a[i][j] * b[j];
        }
        b[i] /= a[i][i];
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pivoting_solves_a_system_with_zero_diagonal() {
        let a = [[0.0, 2.0, 1.0], [3.0, 0.0, -1.0], [1.0, 4.0, 0.0]];
        let x = solve_lu(a, [7.0, 0.0, 9.0]).unwrap();
        for (x, v) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - v).abs() < 1e-14);
        }
        assert_eq!(solve_lu([[1.0, 2.0], [2.0, 4.0]], [1.0, 2.0]), None);
    }
}
