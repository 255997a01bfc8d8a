//! Spatial vectors and inertias about one common point (Featherstone 2008, chapter 2; rotation first).

use super::{Mat3, Spatial, Vec3, add, cross, scale};

/// Rotational half.
pub fn rotational(v: &Spatial) -> Vec3 {
    [v[0], v[1], v[2]]
}

/// Linear half.
pub fn linear(v: &Spatial) -> Vec3 {
    [v[3], v[4], v[5]]
}

/// Joins the halves.
pub fn spatial(rotational: Vec3, linear: Vec3) -> Spatial {
    [rotational[0], rotational[1], rotational[2], linear[0], linear[1], linear[2]]
}

/// Inner product of a motion and a force, in the order of additions of [`dense::dot_slice`](super::dense::dot_slice).
pub fn spatial_dot(a: &Spatial, b: &Spatial) -> f64 {
    ((a[0] * b[0] + a[2] * b[2]) + (a[1] * b[1] + a[3] * b[3])) + (a[4] * b[4] + a[5] * b[5])
}

/// `a += s b`.
pub fn spatial_add_scaled(a: &mut Spatial, b: &Spatial, s: f64) {
    for i in 0..6 {
        a[i] += s * b[i];
    }
}

/// Rate of change of motion `v` fixed in a frame that moves with `u`: `u × v`.
pub fn cross_motion(u: &Spatial, v: &Spatial) -> Spatial {
    let (w, l) = (rotational(u), linear(u));
    spatial(cross(w, rotational(v)), add(cross(w, linear(v)), cross(l, rotational(v))))
}

/// Rate of change of force `f` fixed in a frame that moves with `u`: `u ×* f`.
pub fn cross_force(u: &Spatial, f: &Spatial) -> Spatial {
    let (w, l) = (rotational(u), linear(u));
    spatial(add(cross(w, rotational(f)), cross(l, linear(f))), cross(w, linear(f)))
}

/// Inertia about a point at `-offset` from the centre of mass: 6 entries of the rotational inertia
/// (xx yy zz xy xz yz), mass times offset, mass. `axes` are the principal axes, `moments` their inertias.
pub fn inertia_about(moments: Vec3, axes: &Mat3, offset: Vec3, mass: f64) -> [f64; 10] {
    let r = |i: usize, j: usize| {
        axes[3 * i] * (axes[3 * j] * moments[0])
            + axes[3 * i + 1] * (axes[3 * j + 1] * moments[1])
            + axes[3 * i + 2] * (axes[3 * j + 2] * moments[2])
    };
    let [x, y, z] = offset;
    let m = scale(offset, mass);
    [
        r(0, 0) + mass * (y * y + z * z),
        r(1, 1) + mass * (x * x + z * z),
        r(2, 2) + mass * (x * x + y * y),
        r(0, 1) - mass * x * y,
        r(0, 2) - mass * x * z,
        r(1, 2) - mass * y * z,
        m[0],
        m[1],
        m[2],
        mass,
    ]
}

/// Momentum (or force) of inertia `i` moving with `v`.
pub fn mul_inertia(i: &[f64; 10], v: &Spatial) -> Spatial {
    [
        i[0] * v[0] + i[3] * v[1] + i[4] * v[2] - i[8] * v[4] + i[7] * v[5],
        i[3] * v[0] + i[1] * v[1] + i[5] * v[2] + i[8] * v[3] - i[6] * v[5],
        i[4] * v[0] + i[5] * v[1] + i[2] * v[2] - i[7] * v[3] + i[6] * v[4],
        i[8] * v[1] - i[7] * v[2] + i[9] * v[3],
        i[6] * v[2] - i[8] * v[0] + i[9] * v[4],
        i[7] * v[0] - i[6] * v[1] + i[9] * v[5],
    ]
}

/// Force `f` (or motion, with rotation and translation exchanged) moved from point `from` to point `to`,
/// expressed in the same orientation: torque changes by `(from - to) × force`.
pub fn move_force(f: &Spatial, from: Vec3, to: Vec3) -> Spatial {
    let arm = super::sub(from, to);
    spatial(add(rotational(f), cross(arm, linear(f))), linear(f))
}
