//! Unit quaternions, w-x-y-z (Hamilton product, active rotations).

use super::{Mat3, Quat, Vec3, add, cross, dot, normalize, ops, scale};
use crate::math::MINVAL;

/// No rotation.
pub const IDENTITY: Quat = [1.0, 0.0, 0.0, 0.0];

/// Product `a b`: first `b`, then `a`.
pub fn quat_mul(a: Quat, b: Quat) -> Quat {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// Product of a quaternion and a pure vector.
pub fn quat_mul_axis(q: Quat, v: Vec3) -> Quat {
    [
        -q[1] * v[0] - q[2] * v[1] - q[3] * v[2],
        q[0] * v[0] + q[2] * v[2] - q[3] * v[1],
        q[0] * v[1] + q[3] * v[0] - q[1] * v[2],
        q[0] * v[2] + q[1] * v[1] - q[2] * v[0],
    ]
}

/// Inverse of a unit quaternion.
pub fn quat_conj(q: Quat) -> Quat {
    [q[0], -q[1], -q[2], -q[3]]
}

/// `v` rotated by `q`.
pub fn quat_rotate(q: Quat, v: Vec3) -> Vec3 {
    if q == IDENTITY || v == [0.0; 3] {
        return v;
    }
    let u = [q[1], q[2], q[3]];
    let t = [
        q[0] * v[0] + q[2] * v[2] - q[3] * v[1],
        q[0] * v[1] + q[3] * v[0] - q[1] * v[2],
        q[0] * v[2] + q[1] * v[1] - q[2] * v[0],
    ];
    add(v, scale(cross(u, t), 2.0))
}

/// Unit quaternion of the same direction; no rotation for one shorter than `MINVAL`.
pub fn quat_normalize(q: Quat) -> Quat {
    let n = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    if n < MINVAL {
        IDENTITY
    } else if (n - 1.0).abs() > MINVAL {
        let s = 1.0 / n;
        [q[0] * s, q[1] * s, q[2] * s, q[3] * s]
    } else {
        q
    }
}

/// Rotation matrix of `q`.
pub fn quat_to_mat(q: Quat) -> Mat3 {
    if q == IDENTITY {
        return [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    }
    let [w, x, y, z] = q;
    [
        w * w + x * x - y * y - z * z,
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    ]
}

/// Unit quaternion of a rotation matrix, from its largest component (Shepperd 1978).
pub fn mat_to_quat(m: &Mat3) -> Quat {
    let trace = m[0] + m[4] + m[8];
    let mut q = [0.0; 4];
    if trace > 0.0 {
        q[0] = 0.5 * (1.0 + m[0] + m[4] + m[8]).sqrt();
        q[1] = 0.25 * (m[7] - m[5]) / q[0];
        q[2] = 0.25 * (m[2] - m[6]) / q[0];
        q[3] = 0.25 * (m[3] - m[1]) / q[0];
    } else if m[0] > m[4] && m[0] > m[8] {
        q[1] = 0.5 * (1.0 + m[0] - m[4] - m[8]).sqrt();
        q[0] = 0.25 * (m[7] - m[5]) / q[1];
        q[2] = 0.25 * (m[1] + m[3]) / q[1];
        q[3] = 0.25 * (m[2] + m[6]) / q[1];
    } else if m[4] > m[8] {
        q[2] = 0.5 * (1.0 - m[0] + m[4] - m[8]).sqrt();
        q[0] = 0.25 * (m[2] - m[6]) / q[2];
        q[1] = 0.25 * (m[1] + m[3]) / q[2];
        q[3] = 0.25 * (m[5] + m[7]) / q[2];
    } else {
        q[3] = 0.5 * (1.0 - m[0] - m[4] + m[8]).sqrt();
        q[0] = 0.25 * (m[3] - m[1]) / q[3];
        q[1] = 0.25 * (m[2] + m[6]) / q[3];
        q[2] = 0.25 * (m[5] + m[7]) / q[3];
    }
    quat_normalize(q)
}

/// Rotation by `angle` about the unit vector `axis`.
pub fn quat_from_axis_angle(axis: Vec3, angle: f64) -> Quat {
    if angle == 0.0 {
        return IDENTITY;
    }
    let (s, c) = ops::sincos(0.5 * angle);
    [c, axis[0] * s, axis[1] * s, axis[2] * s]
}

/// Shortest rotation that takes the z axis to `direction`.
pub fn quat_from_z(direction: Vec3) -> Quat {
    let (to, length) = normalize(direction);
    if length < MINVAL {
        return IDENTITY;
    }
    let z = [0.0, 0.0, 1.0];
    let (axis, sine) = normalize(cross(z, to));
    let cosine = dot(to, z);
    if sine.abs() >= MINVAL {
        quat_from_axis_angle(axis, ops::angle(sine, cosine))
    } else if cosine < 0.0 {
        [0.0, 1.0, 0.0, 0.0]
    } else {
        IDENTITY
    }
}

/// Rotation vector `angle * axis`, divided by `dt`, with the angle in (-pi, pi].
pub fn quat_to_velocity(q: Quat, dt: f64) -> Vec3 {
    let (axis, sin_half) = normalize([q[1], q[2], q[3]]);
    let mut angle = 2.0 * ops::atan2(sin_half, q[0]);
    if angle > std::f64::consts::PI {
        angle -= 2.0 * std::f64::consts::PI;
    }
    scale(axis, angle / dt)
}

/// Rotation vector that takes `b` to `a`, in the frame of `b`.
pub fn quat_difference(a: Quat, b: Quat) -> Vec3 {
    quat_to_velocity(quat_mul(quat_conj(b), a), 1.0)
}

/// `q`, normalised, after turning with angular velocity `w`, in its own frame, for `dt`.
pub fn quat_integrate(q: Quat, w: Vec3, dt: f64) -> Quat {
    let (axis, speed) = normalize(w);
    quat_mul(quat_normalize(q), quat_from_axis_angle(axis, speed * dt))
}
