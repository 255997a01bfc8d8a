//! Small symmetric equations, solved through eigenvalues: Jacobi's method (Golub and Van Loan, Matrix Computations,
//! section 8.5).

/// Rows of the largest matrix.
pub(crate) const ROWS: usize = 6;

/// A matrix of which the first few rows and columns are used.
pub(crate) type Square = [[f64; ROWS]; ROWS];

/// Sweeps after which rounding is all that is left; fewer than ten are usual.
const MAX_SWEEPS: usize = 50;

/// The shortest `x` that brings (`a` + `damping` I) `x` as near to `b` as can be. `a` is symmetric without negative
/// eigenvalues; without damping, those that are rounding errors beside the largest count as zero.
pub(crate) fn solve(a: &Square, damping: f64, b: &[f64; ROWS]) -> [f64; ROWS] {
    let (values, vectors) = eigen(a);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let least = if damping > 0.0 { f64::NEG_INFINITY } else { f64::EPSILON * largest };
    let mut x = [0.0; ROWS];
    for k in 0..ROWS {
        let denominator = values[k] + damping;
        if values[k] > least && denominator > 0.0 {
            let along: f64 = (0..ROWS).map(|i| vectors[i][k] * b[i]).sum();
            for i in 0..ROWS {
                x[i] += vectors[i][k] * along / denominator;
            }
        }
    }
    x
}

/// Eigenvalues and, as columns, eigenvectors.
fn eigen(a: &Square) -> ([f64; ROWS], Square) {
    let mut a = *a;
    let mut vectors: Square = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for p in 0..ROWS {
            for q in p + 1..ROWS {
                let negligible = f64::EPSILON * 0.01 * (a[p][p] * a[q][q]).abs().sqrt();
                if a[p][q].abs() > negligible.max(f64::MIN_POSITIVE) {
                    rotate(&mut a, &mut vectors, p, q);
                    rotated = true;
                }
            }
        }
        if !rotated {
            break;
        }
    }
    (std::array::from_fn(|i| a[i][i]), vectors)
}

/// Turns the plane of `p` and `q` until their entry off the diagonal is zero.
fn rotate(a: &mut Square, vectors: &mut Square, p: usize, q: usize) {
    let half_difference = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let tangent = half_difference.signum() / (half_difference.abs() + half_difference.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    let turn = |x: f64, y: f64| (cosine * x - sine * y, sine * x + cosine * y);
    for k in 0..ROWS {
        (a[k][p], a[k][q]) = turn(a[k][p], a[k][q]);
    }
    for k in 0..ROWS {
        (a[p][k], a[q][k]) = turn(a[p][k], a[q][k]);
        (vectors[k][p], vectors[k][q]) = turn(vectors[k][p], vectors[k][q]);
    }
    (a[p][q], a[q][p]) = (0.0, 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B Bᵀ of a few numbers that follow no pattern, of the given rank.
    fn square(rank: usize) -> Square {
        let entry = |i: usize, k: usize| (((i + 1) * (i + 2 * k + 3) * (k + 1)) as f64).sin();
        std::array::from_fn(|i| std::array::from_fn(|j| (0..rank).map(|k| entry(i, k) * entry(j, k)).sum()))
    }

    fn product(a: &Square, x: &[f64; ROWS]) -> [f64; ROWS] {
        std::array::from_fn(|i| (0..ROWS).map(|j| a[i][j] * x[j]).sum())
    }

    fn distance(a: &[f64; ROWS], b: &[f64; ROWS]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_solution_fulfils_its_equation() {
        let a = square(ROWS);
        let x = [1.0, -2.0, 0.5, 3.0, 0.0, -1.0];
        assert!(distance(&solve(&a, 0.0, &product(&a, &x)), &x) < 1e-8);
        let damped = solve(&a, 0.3, &x);
        let back: [f64; ROWS] = std::array::from_fn(|i| product(&a, &damped)[i] + 0.3 * damped[i]);
        assert!(distance(&back, &x) < 1e-12);
    }

    #[test]
    fn of_many_solutions_the_shortest_is_found() {
        let a = square(3);
        let b = product(&a, &[1.0, 2.0, 3.0, -1.0, -2.0, 0.5]);
        let x = solve(&a, 0.0, &b);
        assert!(distance(&product(&a, &x), &b) < 1e-10);
        // The shortest is itself a product with `a`, so that solving once more and multiplying gives it back.
        assert!(distance(&product(&a, &solve(&a, 0.0, &x)), &x) < 1e-8);
        assert_eq!(solve(&[[0.0; ROWS]; ROWS], 0.0, &b), [0.0; ROWS]);
    }
}
