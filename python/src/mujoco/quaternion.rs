//! Quaternions, in the one implementation that physics uses. Components w, x, y, z.

use physics::math::{
    Mat3, Quat, Vec3, principal_axes, quat_conj, quat_difference, quat_from_axis_angle, quat_integrate,
    quat_mul, quat_mul_axis, quat_normalize, quat_rotate, quat_to_mat, quat_to_velocity,
};
use pyo3::prelude::*;

/// Product.
#[pyfunction]
pub fn multiply(a: Quat, b: Quat) -> Quat {
    quat_mul(a, b)
}

/// Product with the quaternion `(0, axis)`.
#[pyfunction]
pub fn multiply_axis(q: Quat, axis: Vec3) -> Quat {
    quat_mul_axis(q, axis)
}

/// Conjugate.
#[pyfunction]
pub fn conjugate(q: Quat) -> Quat {
    quat_conj(q)
}

/// A vector, turned.
#[pyfunction]
pub fn rotate(v: Vec3, q: Quat) -> Vec3 {
    quat_rotate(q, v)
}

/// Of unit length; the identity for zeros.
#[pyfunction]
pub fn normalise(q: Quat) -> Quat {
    quat_normalize(q)
}

/// Rotation matrix, row-major.
#[pyfunction]
pub fn matrix(q: Quat) -> Mat3 {
    quat_to_mat(q)
}

/// Rotation about an axis [rad].
#[pyfunction]
pub fn of_axis_angle(axis: Vec3, angle: f64) -> Quat {
    quat_from_axis_angle(axis, angle)
}

/// Angular velocity that makes this rotation in `dt`.
#[pyfunction]
pub fn velocity(q: Quat, dt: f64) -> Vec3 {
    quat_to_velocity(q, dt)
}

/// The rotation vector `v` with `b · exp(v) = a`.
#[pyfunction]
pub fn subtract(a: Quat, b: Quat) -> Vec3 {
    quat_difference(a, b)
}

/// The quaternion after turning with velocity `w` for `dt`.
#[pyfunction]
pub fn integrate(q: Quat, w: Vec3, dt: f64) -> Quat {
    quat_integrate(q, w, dt)
}

/// Eigenvalues of a symmetric matrix, falling, and the frame of its eigenvectors.
#[pyfunction]
pub fn eigen(matrix: Mat3) -> (Vec3, Quat) {
    principal_axes(&matrix)
}
