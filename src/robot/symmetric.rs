//! Small symmetric equations, solved through eigenvalues (Golub and Van Loan, Matrix Computations, section 5.5).

use physics::math::diagonalize;

/// Rows of the largest matrix.
pub(crate) const ROWS: usize = 6;

/// A matrix; its first few rows and columns are used.
pub(crate) type Square = [[f64; ROWS]; ROWS];

/// The shortest `x` that brings (`a` + `damping` I) `x` as near to `b` as can be. `a` is symmetric without negative
/// eigenvalues; without damping, those that are rounding errors beside the largest count as zero.
pub(crate) fn solve(a: &Square, damping: f64, b: &[f64; ROWS]) -> [f64; ROWS] {
    let (mut diagonal, mut vectors) = (*a, [[0.0; ROWS]; ROWS]);
    let trace: f64 = (0..ROWS).map(|k| a[k][k]).sum();
    diagonalize(diagonal.as_flattened_mut(), vectors.as_flattened_mut(), ROWS, f64::EPSILON * trace);
    let values: [f64; ROWS] = std::array::from_fn(|k| diagonal[k][k]);
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
