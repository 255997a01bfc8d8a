//! Conversions between this project's arrays and glam's types, which are used only for rapier.

use physics::math::{Quat, Vec3};
use rapier3d_f64::math::{Pose, Rotation, Vector};

pub(crate) fn vector([x, y, z]: Vec3) -> Vector {
    Vector::new(x, y, z)
}

pub(crate) fn array(v: Vector) -> Vec3 {
    [v.x, v.y, v.z]
}

/// A rotation from a quaternion, w first, of any length but zero.
pub(crate) fn rotation([w, x, y, z]: Quat) -> Rotation {
    Rotation::from_xyzw(x, y, z, w).normalize()
}

/// A quaternion, w first.
pub(crate) fn quaternion(r: Rotation) -> Quat {
    [r.w, r.x, r.y, r.z]
}

pub(crate) fn pose(position: Vec3, orientation: Quat) -> Pose {
    Pose::from_parts(vector(position), rotation(orientation))
}
