//! The ways MJCF writes an orientation (XML reference, "Frame orientations").

use super::settings::Compiler;
use crate::vector::{EPS, compose, cross, dot, normalize};
use physics::math::ops;
use physics::math::{Quat, Vec3};
use std::f64::consts::PI;
use std::fmt;

/// No rotation.
pub(crate) const UNIT: Quat = [1.0, 0.0, 0.0, 0.0];

/// An orientation that is not a quaternion; angles in the unit of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Axis (any length) and angle.
    AxisAngle([f64; 4]),
    /// X axis and a second axis that spans the xy-plane.
    XyAxes([f64; 6]),
    /// Z axis; minimal rotation from the vertical.
    ZAxis([f64; 3]),
    /// Euler angles in the order of `compiler.eulerseq`.
    Euler([f64; 3]),
}

/// An orientation without a direction: why it has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OrientationError(String);

impl fmt::Display for OrientationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for OrientationError {}

impl Compiler {
    /// The quaternion that `quat`, or an orientation given in another way, means under these settings.
    ///
    /// # Errors
    /// The orientation has no direction.
    pub fn quaternion(&self, quat: [f64; 4], alt: Option<Orientation>) -> Result<[f64; 4], OrientationError> {
        resolve(quat, alt, self).map_err(OrientationError)
    }
}

/// The quaternion that `quat` or the alternative gives, in MuJoCo's order of operations.
pub(crate) fn resolve(quat: Quat, alt: Option<Orientation>, settings: &Compiler) -> Result<Quat, String> {
    let radians = |x: f64| if settings.degree { x / 180.0 * PI } else { x };
    match alt {
        None => Ok(quat),
        Some(Orientation::AxisAngle([x, y, z, angle])) => {
            let mut axis = [x, y, z];
            if normalize(&mut axis) < EPS {
                return Err("axisangle has no axis".into());
            }
            let half = radians(angle) / 2.0;
            let (s, c) = (ops::sin(half), ops::cos(half));
            Ok([c, s * axis[0], s * axis[1], s * axis[2]])
        }
        Some(Orientation::XyAxes(a)) => from_xy([a[0], a[1], a[2]], [a[3], a[4], a[5]]),
        Some(Orientation::ZAxis(mut z)) => {
            if normalize(&mut z) < EPS {
                return Err("zaxis has no length".into());
            }
            Ok(minimal_rotation(z))
        }
        Some(Orientation::Euler(angles)) => from_euler(angles.map(radians), &settings.eulerseq),
    }
}

fn from_xy(mut x: Vec3, mut y: Vec3) -> Result<Quat, String> {
    if normalize(&mut x) < EPS {
        return Err("x axis has no length".into());
    }
    let d = dot(x, y);
    y = [y[0] - x[0] * d, y[1] - x[1] * d, y[2] - x[2] * d];
    if normalize(&mut y) < EPS {
        return Err("x and y axes are parallel".into());
    }
    let mut z = cross(x, y);
    if normalize(&mut z) < EPS {
        return Err("x and y axes are parallel".into());
    }
    Ok(from_axes(x, y, z))
}

/// Quaternion of the rotation whose matrix has these columns (largest component first, Shepperd).
pub(crate) fn from_axes(x: Vec3, y: Vec3, z: Vec3) -> Quat {
    let (xx, yy, zz) = (x[0], y[1], z[2]);
    let mut q = [0.0; 4];
    if xx + yy + zz > 0.0 {
        q[0] = 0.5 * (1.0 + xx + yy + zz).sqrt();
        q[1] = 0.25 * (y[2] - z[1]) / q[0];
        q[2] = 0.25 * (z[0] - x[2]) / q[0];
        q[3] = 0.25 * (x[1] - y[0]) / q[0];
    } else if xx > yy && xx > zz {
        q[1] = 0.5 * (1.0 + xx - yy - zz).sqrt();
        q[0] = 0.25 * (y[2] - z[1]) / q[1];
        q[2] = 0.25 * (y[0] + x[1]) / q[1];
        q[3] = 0.25 * (z[0] + x[2]) / q[1];
    } else if yy > zz {
        q[2] = 0.5 * (1.0 - xx + yy - zz).sqrt();
        q[0] = 0.25 * (z[0] - x[2]) / q[2];
        q[1] = 0.25 * (y[0] + x[1]) / q[2];
        q[3] = 0.25 * (z[1] + y[2]) / q[2];
    } else {
        q[3] = 0.5 * (1.0 - xx - yy + zz).sqrt();
        q[0] = 0.25 * (x[1] - y[0]) / q[3];
        q[1] = 0.25 * (z[0] + x[2]) / q[3];
        q[2] = 0.25 * (z[1] + y[2]) / q[3];
    }
    normalize(&mut q);
    q
}

/// Shortest rotation that takes the z axis to the unit vector `v`.
pub(crate) fn minimal_rotation(v: Vec3) -> Quat {
    let mut axis = cross([0.0, 0.0, 1.0], v);
    let s = normalize(&mut axis);
    if s < 1e-10 {
        axis = [1.0, 0.0, 0.0];
    }
    let half = ops::atan2(s, v[2]) / 2.0;
    let (sine, cosine) = (ops::sin(half), ops::cos(half));
    [cosine, axis[0] * sine, axis[1] * sine, axis[2] * sine]
}

fn from_euler(angles: Vec3, sequence: &[u8; 3]) -> Result<Quat, String> {
    let mut quat = UNIT;
    for (angle, letter) in angles.iter().zip(sequence) {
        let axis = match letter.to_ascii_lowercase() {
            b'x' => 1,
            b'y' => 2,
            b'z' => 3,
            _ => return Err("eulerseq has a letter other than x, y, z, X, Y, Z".into()),
        };
        let mut turn = [ops::cos(angle / 2.0), 0.0, 0.0, 0.0];
        turn[axis] = ops::sin(angle / 2.0);
        quat = if letter.is_ascii_lowercase() { compose(quat, turn) } else { compose(turn, quat) };
    }
    normalize(&mut quat);
    Ok(quat)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Quat, b: Quat) -> bool {
        (0..4).all(|k| (a[k] - b[k]).abs() < 1e-14)
    }

    #[test]
    fn alternatives_describe_one_rotation() {
        // A quarter turn about z, in five ways.
        let settings = Compiler::default();
        let h = 0.5f64.sqrt();
        let quarter = [h, 0.0, 0.0, h];
        let ways = [
            Orientation::AxisAngle([0.0, 0.0, 3.0, 90.0]),
            Orientation::XyAxes([0.0, 2.0, 0.0, -1.0, 5.0, 0.0]),
            Orientation::Euler([0.0, 0.0, 90.0]),
        ];
        for way in ways {
            assert!(close(resolve(UNIT, Some(way), &settings).unwrap(), quarter), "{way:?}");
        }
        let tilted = resolve(UNIT, Some(Orientation::ZAxis([0.0, -2.0, 0.0])), &settings).unwrap();
        assert!(close(tilted, [h, h, 0.0, 0.0]));
    }

    #[test]
    fn fixed_and_moving_axes_reverse_the_order() {
        let moving = Compiler { degree: false, ..Default::default() };
        let fixed = Compiler { eulerseq: *b"ZYX", ..moving.clone() };
        let a = resolve(UNIT, Some(Orientation::Euler([0.3, -0.8, 1.1])), &moving).unwrap();
        let b = resolve(UNIT, Some(Orientation::Euler([1.1, -0.8, 0.3])), &fixed).unwrap();
        assert!(close(a, b) && a[2].abs() > 0.1);
    }
}
