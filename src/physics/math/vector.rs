//! Three-vectors and 3x3 matrices.

use super::{Mat3, Vec3};
use crate::math::MINVAL;

/// Sum.
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Difference.
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Product with a scalar.
pub fn scale(a: Vec3, s: f64) -> Vec3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// `a + s b`.
pub fn add_scaled(a: Vec3, b: Vec3, s: f64) -> Vec3 {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// Inner product.
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Matrix `A` with `A b = a × b`.
pub fn cross_matrix(a: Vec3) -> Mat3 {
    [0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0]
}

/// Euclidean length.
pub fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// Distance between two points.
pub fn distance(a: Vec3, b: Vec3) -> f64 {
    norm(sub(a, b))
}

/// Unit vector and length; the x axis for a vector shorter than `MINVAL`.
pub fn normalize(a: Vec3) -> (Vec3, f64) {
    let n = norm(a);
    (unit(a, n), n)
}

/// Unit vector of a vector whose length is known; the x axis for one shorter than `MINVAL`.
pub fn unit(a: Vec3, length: f64) -> Vec3 {
    if length < MINVAL { [1.0, 0.0, 0.0] } else { scale(a, 1.0 / length) }
}

/// Matrix times vector.
pub fn mul_mat_vec(m: &Mat3, v: Vec3) -> Vec3 {
    [
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
        m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
    ]
}

/// Transposed matrix times vector.
pub fn mul_mat_t_vec(m: &Mat3, v: Vec3) -> Vec3 {
    [
        m[0] * v[0] + m[3] * v[1] + m[6] * v[2],
        m[1] * v[0] + m[4] * v[1] + m[7] * v[2],
        m[2] * v[0] + m[5] * v[1] + m[8] * v[2],
    ]
}

/// Matrix product `a b`.
pub fn mul_mat(a: &Mat3, b: &Mat3) -> Mat3 {
    std::array::from_fn(|k| {
        let (r, c) = (k / 3 * 3, k % 3);
        a[r] * b[c] + a[r + 1] * b[c + 3] + a[r + 2] * b[c + 6]
    })
}

/// Matrix product `aᵀ b`.
pub fn mul_mat_t_mat(a: &Mat3, b: &Mat3) -> Mat3 {
    mul_mat(&transpose(a), b)
}

/// Transpose.
pub fn transpose(m: &Mat3) -> Mat3 {
    [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]]
}

/// Row `i`.
pub fn row(m: &Mat3, i: usize) -> Vec3 {
    [m[3 * i], m[3 * i + 1], m[3 * i + 2]]
}

/// Column `i`.
pub fn column(m: &Mat3, i: usize) -> Vec3 {
    [m[i], m[i + 3], m[i + 6]]
}

/// `x` limited to a range; keeps a NaN.
pub fn clip(x: f64, [low, high]: [f64; 2]) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}
