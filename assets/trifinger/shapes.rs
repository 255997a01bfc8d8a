//! What the links of TriFinger look like, each in the frame of its body \[m\]: printed shells that lie side by side, each with a motor
//! under a dark cap and a disc over the pulley of its joint. Widths are judged from photographs and from `trifinger_sim`'s numbers.

use std::f64::consts::{FRAC_PI_2, TAU};
use workshop::{Mesh, Profile, Vec3, capsule, cylinder, loft};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A shell whose outline lies in the plane of y and z, from `low` to `high` along x, its rims cut off by `rim`.
fn shell(outline: &Profile, [low, high]: [f64; 2], rim: f64) -> Mesh {
    let ring = |inset: f64, x: f64| -> Vec<Vec3> {
        outline.inset(inset).points().iter().map(|[y, z]| [x, *y, *z]).collect()
    };
    loft(&[ring(rim, low), ring(0.0, low + rim), ring(0.0, high - rim), ring(rim, high)])
}

/// The cap over a motor, or the disc over a pulley, about the x axis.
fn cap(radius: f64, centre: [f64; 2], along: [f64; 2]) -> Mesh {
    cylinder(radius, along, 0.0015, 20).along(X, [0.0, centre[0], centre[1]])
}

/// The hub in the middle, with the bearing of each finger.
pub(super) fn hub() -> Mesh {
    let core = cylinder(0.024, [-0.022, 0.028], 0.004, 24);
    let bearing = |turn: usize| {
        let bearing = cylinder(0.017, [0.01, 0.029], 0.002, 18).along(Y, [0.0; 3]);
        bearing.turned([0.0, 0.0, 1.0], TAU * turn as f64 / 3.0)
    };
    core.with(&Mesh::of(&[bearing(0), bearing(1), bearing(2)]))
}

/// The link that rolls about its own length, as long as a forearm.
pub(super) fn upper() -> Mesh {
    let outline = Profile::link([0.0245, 0.0255], 0.165, 7).moved([0.0525, 0.0]);
    let belt = Profile::link([0.017, 0.021], 0.114, 6).moved([0.0505, 0.0]);
    shell(&outline, [-0.02, 0.0145], 0.005).with(&shell(&belt, [-0.0235, -0.015], 0.002))
}

pub(super) fn upper_dark() -> Mesh {
    cap(0.0221, [0.1643, 0.0], [0.0135, 0.032]).with(&cap(0.013, [0.0505, 0.0], [-0.0245, 0.0165]))
}

/// The link that swings in and out.
pub(super) fn middle() -> Mesh {
    let outline = Profile::link([0.0245, 0.022], 0.16, 7).turned(-FRAC_PI_2);
    let belt = Profile::link([0.021, 0.015], 0.114, 6).turned(-FRAC_PI_2).moved([0.0, -0.046]);
    shell(&outline, [0.001, 0.046], 0.006).with(&shell(&belt, [-0.002, 0.01], 0.002))
}

pub(super) fn middle_dark() -> Mesh {
    cap(0.0221, [0.0, -0.046], [0.045, 0.0652]).with(&cap(0.012, [0.0, -0.16], [-0.003, 0.051]))
}

/// The last link, flat at the joint and slim at the tip.
pub(super) fn lower() -> Mesh {
    let outline = Profile::link([0.022, 0.0085], 0.132, 7).turned(-FRAC_PI_2);
    let slimmer = |[x, y, z]: Vec3| {
        let share = (1.0 + z / 0.1).clamp(0.0, 1.0);
        let half = 0.62 + 0.38 * share;
        [0.0185 + (x - 0.0155) * half - 0.003 * share, y, z]
    };
    shell(&outline, [0.002, 0.029], 0.004).mapped(slimmer)
}

pub(super) fn lower_dark() -> Mesh {
    cap(0.013, [0.0, 0.0], [0.0005, 0.0305])
}

/// The soft tip.
pub(super) fn tip() -> Mesh {
    capsule(0.01, [0.019, 0.0, -0.143], [0.019, 0.0, -0.16], 16)
}
