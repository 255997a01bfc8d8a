//! What a walk on two feet measures of its body, and geometry in the plane of the ground.

use physics::elements::{BodyId, SiteId};
use physics::math::{Quat, Vec3, cross, mat_to_quat, ops, quat_conj, quat_mul, sub};
use physics::{Data, Model};

/// A point or vector in the plane of the ground \[m\].
pub type Plane = [f64; 2];

/// A foot on the ground, or where one is to be.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    /// Where its sole is \[m\].
    pub at: Plane,
    /// Its direction, about the vertical \[rad\].
    pub yaw: f64,
}

/// A foot as it is.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// Where it is.
    pub place: Place,
    /// Height of its sole \[m\].
    pub height: f64,
    /// How it is inclined to the root: what turns one that has its yaw and is level with the root into it.
    pub incline: Quat,
}

/// A body as it is, world frame.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Centre of mass \[m\].
    pub mass: Plane,
    /// Its velocity \[m/s\].
    pub velocity: Plane,
    /// Place of the root \[m\].
    pub root: Vec3,
    /// Direction of the root \[rad\].
    pub yaw: f64,
    /// The left foot and the right one.
    pub feet: [Foot; 2],
}

impl Seen {
    /// Measures a body with these feet.
    pub fn new(m: &Model, d: &Data, root: BodyId, feet: [SiteId; 2]) -> Self {
        let body = root.index();
        let heading = yaw(&d.kin.xmat[body]);
        let foot = |site: SiteId| {
            let ([x, y, height], axes) = (d.kin.site_xpos[site.index()], &d.kin.site_xmat[site.index()]);
            let place = Place { at: [x, y], yaw: yaw(axes) };
            let relative = quat_mul(quat_conj(d.kin.xquat[body]), mat_to_quat(axes));
            let incline = quat_mul(relative, quat_conj(about(place.yaw - heading)));
            Foot { place, height, incline }
        };
        let [x, y, _] = d.com.subtree_com[body];
        let [u, v, _] = velocity(m, d, root);
        let root = d.kin.xpos[body];
        Seen { mass: [x, y], velocity: [u, v], root, yaw: heading, feet: feet.map(foot) }
    }
}

/// Velocity of the centre of mass of a body and of all that hangs on it \[m/s\].
fn velocity(m: &Model, d: &Data, root: BodyId) -> Vec3 {
    let top = m.body_rootid[root.index()];
    let (mut momentum, mut mass) = ([0.0; 3], 0.0);
    for body in (0..m.nbody).filter(|&body| m.body_rootid[body] == top) {
        let [x, y, z, u, v, w] = d.vel.cvel[body];
        let swing = cross([x, y, z], sub(d.kin.xipos[body], d.com.subtree_com[top as usize]));
        let own = m.body_mass[body];
        mass += own;
        for (sum, part) in momentum.iter_mut().zip([u + swing[0], v + swing[1], w + swing[2]]) {
            *sum += own * part;
        }
    }
    momentum.map(|sum| sum / mass)
}

/// Direction of the x axis of a frame, about the vertical.
fn yaw(axes: &[f64; 9]) -> f64 {
    ops::angle(axes[3], axes[0])
}

/// A vector that is turned counterclockwise.
pub fn rotate([x, y]: Plane, angle: f64) -> Plane {
    let (s, c) = ops::sincos(angle);
    [c * x - s * y, s * x + c * y]
}

/// a + b.
pub fn plus(a: Plane, b: Plane) -> Plane {
    [a[0] + b[0], a[1] + b[1]]
}

/// a - b.
pub fn minus(a: Plane, b: Plane) -> Plane {
    [a[0] - b[0], a[1] - b[1]]
}

/// An angle between -π and π.
pub fn wrap(angle: f64) -> f64 {
    ops::angle(ops::sin(angle), ops::cos(angle))
}

/// A turn about the vertical.
pub fn about(angle: f64) -> Quat {
    let (s, c) = ops::sincos(angle / 2.0);
    [c, 0.0, 0.0, s]
}
