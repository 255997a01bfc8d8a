//! Small symmetric matrices, row by row: solutions by Cholesky's factor, eigenvectors by Jacobi's rotations.

/// Solves `(A + diag) x = b` for a positive definite matrix; None if it is not.
pub(crate) fn solve(a: &[f64], diagonal: &[f64], b: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    let mut l = a.to_vec();
    for i in 0..n {
        l[i * n + i] += diagonal[i];
    }
    for j in 0..n {
        for k in 0..j {
            for i in j..n {
                l[i * n + j] -= l[i * n + k] * l[j * n + k];
            }
        }
        let pivot = l[j * n + j];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        let root = pivot.sqrt();
        (j..n).for_each(|i| l[i * n + j] /= root);
    }
    let mut x = b.to_vec();
    for i in 0..n {
        for k in 0..i {
            x[i] -= l[i * n + k] * x[k];
        }
        x[i] /= l[i * n + i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            x[i] -= l[k * n + i] * x[k];
        }
        x[i] /= l[i * n + i];
    }
    Some(x)
}

/// Eigenvalues in increasing order, each with its eigenvector (Golub and Van Loan, "Matrix computations", 2013, section 8.5:
/// cyclic Jacobi).
pub(crate) fn eigen(a: &[f64], n: usize) -> Vec<(f64, Vec<f64>)> {
    let mut a = a.to_vec();
    let mut v: Vec<f64> = (0..n * n).map(|i| if i % (n + 1) == 0 { 1.0 } else { 0.0 }).collect();
    let size: f64 = a.iter().map(|x| x * x).sum();
    for _sweep in 0..60 {
        let off: f64 = (0..n * n).filter(|i| i % (n + 1) != 0).map(|i| a[i] * a[i]).sum();
        if off <= 1e-30 * size {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut v, n, p, q);
            }
        }
    }
    let mut pairs: Vec<_> =
        (0..n).map(|j| (a[j * n + j], (0..n).map(|i| v[i * n + j]).collect::<Vec<_>>())).collect();
    pairs.sort_by(|x, y| x.0.total_cmp(&y.0));
    pairs
}

/// One rotation, which makes `a[p, q]` zero.
fn rotate(a: &mut [f64], v: &mut [f64], n: usize, p: usize, q: usize) {
    let apq = a[p * n + q];
    if apq == 0.0 {
        return;
    }
    let tau = (a[q * n + q] - a[p * n + p]) / (2.0 * apq);
    let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        (a[k * n + p], a[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        (a[p * n + k], a[q * n + k]) = (c * x - s * y, s * x + c * y);
        let (x, y) = (v[k * n + p], v[k * n + q]);
        (v[k * n + p], v[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A symmetric matrix with the eigenvalues 0, 1 … n - 1; its eigenvectors are the axes, mirrored.
    fn matrix(n: usize) -> Vec<f64> {
        let normal: Vec<f64> = (0..n).map(|k| (k * k + 1) as f64).collect();
        let square: f64 = normal.iter().map(|x| x * x).sum();
        let mirrored =
            |r: usize, i: usize| f64::from(u8::from(r == i)) - 2.0 * normal[r] * normal[i] / square;
        let entry = |r: usize, c: usize| (0..n).map(|i| i as f64 * mirrored(r, i) * mirrored(c, i)).sum();
        (0..n * n).map(|i| entry(i / n, i % n)).collect()
    }

    #[test]
    fn eigenvectors_are_those_of_the_matrix() {
        let (n, a) = (5, matrix(5));
        for (i, (value, vector)) in eigen(&a, n).into_iter().enumerate() {
            assert!((value - i as f64).abs() < 1e-12, "{i}: {value}");
            for r in 0..n {
                let image: f64 = (0..n).map(|c| a[r * n + c] * vector[c]).sum();
                assert!((image - value * vector[r]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn solutions_solve_and_indefinite_matrices_are_refused() {
        let (n, a) = (5, matrix(5));
        let (extra, b) = (vec![0.5; 5], vec![1.0, -2.0, 0.5, 3.0, 0.0]);
        let x = solve(&a, &extra, &b).unwrap();
        for r in 0..n {
            let image: f64 = (0..n).map(|c| a[r * n + c] * x[c]).sum::<f64>() + 0.5 * x[r];
            assert!((image - b[r]).abs() < 1e-12);
        }
        assert_eq!(solve(&a, &[-10.0; 5], &b), None);
    }
}
