//! Dense vectors and small dense matrices (row-major slices).
//!
//! Inner products keep four running sums, so that the compiler can use vector registers and the order of
//! additions is the same on every target: lanes 0..3 by index modulo 4, then the remainder.

use crate::model::bounds::MINVAL;

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

/// Cholesky factor in the lower triangle of the `n` by `n` matrix `a`: `A = L Lᵀ`. Pivots below `least` are
/// raised to it and their columns cleared; returns the number of sound pivots.
pub fn cholesky_factor(a: &mut [f64], n: usize, least: f64) -> usize {
    let mut rank = n;
    for j in 0..n {
        let (above, below) = a.split_at_mut((j + 1) * n);
        let row = &mut above[j * n..];
        let pivot = row[j] - dot_slice(&row[..j], &row[..j]);
        let sound = pivot >= least;
        row[j] = pivot.max(least).sqrt();
        let inverse = 1.0 / row[j];
        let row = &row[..j];
        for other in below.chunks_exact_mut(n) {
            other[j] = if sound { (other[j] - dot_slice(&other[..j], row)) * inverse } else { 0.0 };
        }
        rank -= usize::from(!sound);
    }
    rank
}

/// Solves `L Lᵀ x = x` in place.
pub fn cholesky_solve(l: &[f64], n: usize, x: &mut [f64]) {
    for i in 0..n {
        x[i] = (x[i] - dot_slice(&l[i * n..i * n + i], &x[..i])) / l[i * (n + 1)];
    }
    for i in (0..n).rev() {
        let mut value = x[i];
        for (row, x) in l[(i + 1) * n..].chunks_exact(n).zip(&x[i + 1..n]) {
            value -= row[i] * x;
        }
        x[i] = value / l[i * (n + 1)];
    }
}

/// Rank-one update `L Lᵀ ± x xᵀ` of a Cholesky factor (Gill, Golub, Murray, Saunders 1974); destroys `x`.
/// Returns the number of pivots that stayed above `least`.
pub fn cholesky_update(l: &mut [f64], n: usize, x: &mut [f64], plus: bool, least: f64) -> usize {
    let mut rank = n;
    for k in 0..n {
        if x[k] == 0.0 {
            continue;
        }
        let pivot = l[k * (n + 1)];
        let mut square = if plus { pivot * pivot + x[k] * x[k] } else { pivot * pivot - x[k] * x[k] };
        if square < least {
            square = least;
            rank -= 1;
        }
        let root = square.sqrt();
        let (c, s) = (root / pivot, x[k] / pivot);
        let (inverse, signed) = (1.0 / c, if plus { s } else { -s });
        l[k * (n + 1)] = root;
        for (row, x) in l[(k + 1) * n..].chunks_exact_mut(n).zip(&mut x[k + 1..n]) {
            row[k] = (row[k] + signed * *x) * inverse;
            *x = c * *x - s * row[k];
        }
    }
    rank
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

    fn spd(n: usize) -> Vec<f64> {
        let value = |i: usize, j: usize| ((3 * i + 7 * j) % 5) as f64 - 2.0;
        let mut a = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                a[i * n + j] =
                    (0..n).map(|k| value(i, k) * value(j, k)).sum::<f64>() + f64::from(u8::from(i == j));
            }
        }
        a
    }

    #[test]
    fn factor_solves_and_updates() {
        let n = 7;
        let a = spd(n);
        let mut l = a.clone();
        assert_eq!(cholesky_factor(&mut l, n, 1e-15), n);
        let v: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
        let mut x = v.clone();
        cholesky_solve(&l, n, &mut x);
        for i in 0..n {
            assert!((dot_slice(&a[i * n..(i + 1) * n], &x) - v[i]).abs() < 1e-10);
        }
        let before = l.clone();
        assert_eq!(cholesky_update(&mut l, n, &mut v.clone(), true, 1e-15), n);
        for i in 0..n {
            for j in 0..=i {
                let product = dot_slice(&l[i * n..i * n + j + 1], &l[j * n..j * n + j + 1]);
                assert!((product - a[i * n + j] - v[i] * v[j]).abs() < 1e-9);
            }
        }
        assert_eq!(cholesky_update(&mut l, n, &mut v.clone(), false, 1e-15), n);
        for i in 0..n {
            for j in 0..=i {
                assert!((l[i * n + j] - before[i * n + j]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn deficient_pivot_is_counted() {
        let mut a = vec![1.0, 0.0, 1.0, 1.0];
        assert_eq!(cholesky_factor(&mut a, 2, 1e-15), 1);
        assert_eq!(a[3], 1e-15_f64.sqrt());
    }

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
