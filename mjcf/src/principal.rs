//! Principal axes: eigen decomposition of a symmetric 3×3 matrix by Jacobi rotations kept as a
//! quaternion (Golub & Van Loan, "Matrix Computations", section 8.5).

use crate::vector::{compose, matrix, normalize, product, transpose};

const EPS: f64 = 1e-12;

/// Eigenvalues in decreasing order and the orientation of their axes.
pub fn principal_axes(m: &[f64; 9]) -> ([f64; 3], [f64; 4]) {
    let mut quat = [1.0, 0.0, 0.0, 0.0];
    let mut values = [0.0; 3];
    for _ in 0..500 {
        let axes = matrix(quat);
        let d = product(&product(&transpose(&axes), m), &axes);
        values = [d[0], d[4], d[8]];
        let (row, col, axis) = largest_off_diagonal(&d);
        let off = d[3 * row + col];
        if off.abs() < EPS {
            break;
        }
        let tau = (d[4 * col] - d[4 * row]) / (2.0 * off);
        let root = (1.0 + tau * tau).sqrt();
        let tangent = if tau >= 0.0 { 1.0 / (tau + root) } else { -1.0 / (-tau + root) };
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        if cosine > 1.0 - EPS {
            break;
        }
        let half_sine = (0.5 - 0.5 * cosine).sqrt();
        let mut turn = [0.0; 4];
        turn[axis + 1] = if (tau >= 0.0) == (axis == 1) { half_sine } else { -half_sine };
        turn[0] = (1.0 - turn[axis + 1] * turn[axis + 1]).sqrt();
        normalize(&mut turn);
        quat = compose(quat, turn);
        normalize(&mut quat);
    }
    sort_decreasing(&mut values, &mut quat);
    (values, quat)
}

/// Row, column and rotation axis of the largest off-diagonal element.
fn largest_off_diagonal(d: &[f64; 9]) -> (usize, usize, usize) {
    if d[1].abs() > d[2].abs() && d[1].abs() > d[5].abs() {
        (0, 1, 2)
    } else if d[2].abs() > d[5].abs() {
        (0, 2, 1)
    } else {
        (1, 2, 0)
    }
}

/// Bubble sort; each swap is a quarter turn of the axes.
fn sort_decreasing(values: &mut [f64; 3], quat: &mut [f64; 4]) {
    // MuJoCo's fifteen digits of 1/sqrt(2): orientations of compiled meshes depend on them.
    const HALF_SQRT: f64 = 707106781186548e-15;
    for lead in [0, 1, 0] {
        if values[lead] + EPS < values[lead + 1] {
            values.swap(lead, lead + 1);
            let mut turn = [HALF_SQRT, 0.0, 0.0, 0.0];
            turn[(lead + 2) % 3 + 1] = HALF_SQRT;
            *quat = compose(*quat, turn);
            normalize(quat);
        }
    }
}
