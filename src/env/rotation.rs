//! Rotations as RoboHive's tasks state them: Euler angles about the moving x, y and z axes, in this order.
//!
//! ```
//! use robohive_env::rotation::{euler_of_quat, quat_of_euler};
//!
//! let euler = [0.3, -0.8, 1.1];
//! let again = euler_of_quat(quat_of_euler(euler));
//! assert!(euler.iter().zip(again).all(|(a, b)| (a - b).abs() < 1e-12));
//! ```

use physics::math::{Mat3, Quat, Vec3, ops};
use physics::math::{quat_conj, quat_from_axis_angle, quat_mul};
use std::f64::consts::TAU;

/// The cosine of the middle angle is below this in gimbal lock.
const GIMBAL_LOCK: f64 = 4.0 * f64::EPSILON;

/// The shorter way round of a turn: the angle within half a turn of zero \[rad\].
pub fn shorter(turn: f64) -> f64 {
    turn - TAU * (turn / TAU).round()
}

/// The quaternion of a rotation about x, then about the new y, then about the new z \[rad\].
pub fn quat_of_euler(euler: Vec3) -> Quat {
    let [x, y, z] = euler;
    let about = |axis, angle| quat_from_axis_angle(axis, angle);
    quat_mul(quat_mul(about([1.0, 0.0, 0.0], x), about([0.0, 1.0, 0.0], y)), about([0.0, 0.0, 1.0], z))
}

/// The angles about x, y and z \[rad\] of a rotation matrix; the middle one within ±π/2. In gimbal lock the first is zero.
pub fn euler_of_mat(mat: &Mat3) -> Vec3 {
    let [xx, xy, xz, yx, yy, yz, _, _, zz] = *mat;
    let cosine = ops::sqrt(zz * zz + yz * yz);
    let y = ops::atan2(xz, cosine);
    if cosine > GIMBAL_LOCK {
        [ops::atan2(-yz, zz), y, ops::atan2(-xy, xx)]
    } else {
        [0.0, y, ops::atan2(yx, yy)]
    }
}

/// The angles about x, y and z \[rad\] of a quaternion of any length.
pub fn euler_of_quat(quat: Quat) -> Vec3 {
    euler_of_mat(&mat_of_quat(quat))
}

/// The rotation matrix of a quaternion of any length; the identity for one that is zero.
pub fn mat_of_quat(quat: Quat) -> Mat3 {
    let square: f64 = quat.iter().map(|x| x * x).sum();
    if square <= f64::EPSILON {
        return [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    }
    let [w, x, y, z] = quat;
    let twice = |a: f64, b: f64| 2.0 / square * a * b;
    [
        1.0 - twice(y, y) - twice(z, z),
        twice(x, y) - twice(w, z),
        twice(x, z) + twice(w, y),
        twice(x, y) + twice(w, z),
        1.0 - twice(x, x) - twice(z, z),
        twice(y, z) - twice(w, x),
        twice(x, z) - twice(w, y),
        twice(y, z) + twice(w, x),
        1.0 - twice(x, x) - twice(y, y),
    ]
}

/// The quaternion, w not negative, of a rotation matrix (Shepperd, 1978: the largest component is found first).
pub fn quat_of_mat(mat: &Mat3) -> Quat {
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = *mat;
    // Four times the products of components: row k holds w, x, y, z times component k.
    let products = [
        [1.0 + xx + yy + zz, zy - yz, xz - zx, yx - xy],
        [zy - yz, 1.0 + xx - yy - zz, xy + yx, xz + zx],
        [xz - zx, xy + yx, 1.0 - xx + yy - zz, yz + zy],
        [yx - xy, xz + zx, yz + zy, 1.0 - xx - yy + zz],
    ];
    let largest = (0..4).max_by(|&a, &b| products[a][a].total_cmp(&products[b][b])).unwrap_or(0);
    let row = products[largest];
    let norm = ops::sqrt(row.iter().map(|x| x * x).sum::<f64>());
    let sign = if row[0] < 0.0 { -1.0 } else { 1.0 };
    row.map(|x| sign * x / norm)
}

/// The angle \[rad\] and axis by which `from` turns into `to`, in the frame of the world; the axis is shorter than one where
/// the angle is tiny.
pub fn turn_between(from: Quat, to: Quat) -> (f64, Vec3) {
    let [w, x, y, z] = quat_mul(to, quat_conj(from));
    let sine = ops::sqrt(x * x + y * y + z * z);
    // The constant by which the original avoids a division by zero.
    let axis = [x, y, z].map(|component| component / (sine + 1e-8));
    (2.0 * ops::atan2(sine, w), axis)
}

/// The cosine of the angle between two vectors; zero where one of them is zero.
pub fn cosine(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let norms = ops::sqrt(dot(a, a)) * ops::sqrt(dot(b, b));
    if norms == 0.0 { 0.0 } else { dot(a, b) / norms }
}

/// Euclidean length.
pub fn norm(values: &[f64]) -> f64 {
    ops::sqrt(values.iter().map(|x| x * x).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences that rounding leaves.
    const ROUNDING: f64 = 1e-14;

    fn close(a: &[f64], b: &[f64]) -> bool {
        a.iter().zip(b).all(|(x, y)| (x - y).abs() < ROUNDING)
    }

    #[test]
    fn the_forms_agree() {
        for euler in [[0.3, -0.4, 1.2], [-2.9, 1.5, 0.1], [3.0, 0.0, -3.1]] {
            let quat = quat_of_euler(euler);
            let mat = mat_of_quat(quat);
            assert!(close(&euler_of_mat(&mat), &euler), "{euler:?}");
            let back = quat_of_mat(&mat);
            assert!(close(&back, &quat) || close(&back, &quat.map(|x| -x)), "{euler:?}");
        }
        // The middle axis turns first in the moving frame: x stays, y and z have turned.
        assert!(close(
            &mat_of_quat(quat_of_euler([std::f64::consts::FRAC_PI_2, 0.0, 0.0])),
            &[1., 0., 0., 0., 0., -1., 0., 1., 0.]
        ));
    }

    #[test]
    fn gimbal_lock_keeps_the_rotation() {
        let mat = mat_of_quat(quat_of_euler([0.0, std::f64::consts::FRAC_PI_2, 0.7]));
        let euler = euler_of_mat(&mat);
        assert!(euler.iter().all(|angle| angle.is_finite()));
        let again = mat_of_quat(quat_of_euler(euler));
        assert!(mat.iter().zip(again).all(|(a, b)| (a - b).abs() < 1e-7), "{euler:?}");
    }

    #[test]
    fn turns_have_an_angle_and_an_axis() {
        let (angle, axis) = turn_between(quat_of_euler([0.1, 0.0, 0.0]), quat_of_euler([0.5, 0.0, 0.0]));
        assert!((angle - 0.4).abs() < ROUNDING && (axis[0] - 1.0).abs() < 1e-7);
    }
}
