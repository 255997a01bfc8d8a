//! Eigen decomposition of a symmetric 3x3 matrix by Jacobi rotations kept as a quaternion (Golub and Van Loan,
//! "Matrix Computations", section 8.5).
//!
//! Besides [`diagonalize`](super::diagonalize), which serves matrices of any size, this one stays: the axes of inertia of a
//! compiled model are MuJoCo's to the last bit only if they are kept as a quaternion that is scaled after each turn, and sorted
//! by quarter turns.

use super::{IDENTITY, Mat3, Quat, Vec3, mul_mat, mul_mat_t_mat, quat_mul, quat_normalize, quat_to_mat};

const EPS: f64 = 1e-12;
/// sin 45°, with the digits MuJoCo has: the last bit decides whether bodies that just touch are paired.
#[allow(clippy::approx_constant)]
const HALF_SQRT: f64 = 0.707106781186548;

/// Eigenvalues in decreasing order and the orientation of their axes (columns of the rotation).
pub fn principal_axes(m: &Mat3) -> (Vec3, Quat) {
    principal_axes_by(m, quat_normalize)
}

/// As [`principal_axes`], with `unit` to scale quaternions: its last bits decide the axes of compiled meshes.
pub fn principal_axes_by(m: &Mat3, unit: impl Fn(Quat) -> Quat) -> (Vec3, Quat) {
    let mut quat = IDENTITY;
    let mut values = [0.0; 3];
    for _ in 0..500 {
        let axes = quat_to_mat(quat);
        let d = mul_mat(&mul_mat_t_mat(&axes, m), &axes);
        values = [d[0], d[4], d[8]];
        let (row, column, axis) = largest_off_diagonal(&d);
        let off = d[3 * row + column];
        if off.abs() < EPS {
            break;
        }
        let tau = (d[4 * column] - d[4 * row]) / (2.0 * off);
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
        quat = unit(quat_mul(quat, unit(turn)));
    }
    sort_decreasing(&mut values, &mut quat, unit);
    (values, quat)
}

/// Row, column and rotation axis of the largest off-diagonal element.
fn largest_off_diagonal(d: &Mat3) -> (usize, usize, usize) {
    if d[1].abs() > d[2].abs() && d[1].abs() > d[5].abs() {
        (0, 1, 2)
    } else if d[2].abs() > d[5].abs() {
        (0, 2, 1)
    } else {
        (1, 2, 0)
    }
}

/// Bubble sort; each swap is a quarter turn of the axes.
fn sort_decreasing(values: &mut Vec3, quat: &mut Quat, unit: impl Fn(Quat) -> Quat) {
    for lead in [0, 1, 0] {
        if values[lead] + EPS < values[lead + 1] {
            values.swap(lead, lead + 1);
            let mut turn = [HALF_SQRT, 0.0, 0.0, 0.0];
            turn[(lead + 2) % 3 + 1] = HALF_SQRT;
            *quat = unit(quat_mul(*quat, turn));
        }
    }
}
