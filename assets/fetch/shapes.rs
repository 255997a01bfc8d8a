//! What the links of the Fetch look like, each in the frame of its body \[m\]. Links of the arm alternate: those that flex are blue, with
//! the drum of their joint on one side, those that roll are white, and carry the drum of the next on the other. Only the places of
//! the joints are the maker's; widths are judged from photographs.

use workshop::{Mesh, Profile, Station, Vec3, cylinder, loft, revolve, rounded_box, sweep};

/// Steps round a tube.
const ROUND: usize = 20;
/// Radius of the arm's tubes \[m\].
const TUBE: f64 = 0.052;

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A tube through places, each with its radius.
fn tube(path: &[(Vec3, f64)]) -> Mesh {
    let stations: Vec<_> = path.iter().map(|(at, radius)| Station { at: *at, size: [*radius; 2] }).collect();
    sweep(&Profile::superellipse([1.0, 1.0], 2.3, ROUND), &stations)
}

/// The drum of a joint that flexes, on one side of the arm.
fn drum(radius: f64, x: f64, z: f64, [low, high]: [f64; 2]) -> Mesh {
    cylinder(radius, [low, high], 0.008, ROUND).along(Y, [x, 0.0, z])
}

/// A body of horizontal sections: height, middle and half length along x, half width along y.
fn tower(sections: &[[f64; 4]]) -> Mesh {
    let ring = |[z, x, length, width]: &[f64; 4]| -> Vec<Vec3> {
        let outline = Profile::superellipse([*length, *width], 3.0, 32);
        outline.points().iter().map(|[dx, y]| [x + dx, *y, *z]).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}

/// The round base.
pub(super) fn base() -> Mesh {
    let line = [
        [0.0, 0.02],
        [0.262, 0.02],
        [0.278, 0.035],
        [0.28, 0.2],
        [0.272, 0.3],
        [0.255, 0.345],
        [0.225, 0.365],
        [0.0, 0.368],
    ];
    revolve(&line, 32)
}

/// What is dark of the base: the slot of its laser, and the drive wheels.
pub(super) fn base_dark() -> Mesh {
    let slot = rounded_box([0.075, 0.17, 0.022], 0.008, 1).moved([0.21, 0.0, 0.288]);
    let wheel = |y: f64| cylinder(0.0613, [-0.02, 0.02], 0.006, 18).along(Y, [0.0013, y, 0.0553]);
    Mesh::of(&[slot, wheel(0.1874), wheel(-0.1874)])
}

/// The torso: a column on the base's rear that widens to the shoulder.
pub(super) fn torso() -> Mesh {
    tower(&[
        [-0.012, -0.07, 0.15, 0.19],
        [0.05, -0.075, 0.14, 0.18],
        [0.16, -0.085, 0.12, 0.165],
        [0.26, -0.07, 0.13, 0.16],
        [0.285, 0.0, 0.185, 0.16],
        [0.305, 0.015, 0.2, 0.163],
        [0.325, 0.01, 0.195, 0.163],
        [0.345, -0.045, 0.14, 0.16],
        [0.45, -0.055, 0.125, 0.15],
        [0.56, -0.045, 0.12, 0.14],
        [0.59, -0.04, 0.105, 0.125],
        [0.6, -0.04, 0.085, 0.105],
    ])
}

/// The bellows below the shoulder, which hides the lift.
pub(super) fn torso_dark() -> Mesh {
    let folds = (0..7).map(|fold| {
        let wide = if fold % 2 == 0 { 0.0 } else { 0.012 };
        [0.002 + 0.045 * f64::from(fold), 0.055, 0.07 - wide, 0.115 - wide]
    });
    tower(&folds.collect::<Vec<_>>())
}

/// The neck, and the yoke in which the head tilts.
pub(super) fn head_pan() -> Mesh {
    let neck = cylinder(0.055, [-0.006, 0.03], 0.006, 24);
    let bar = rounded_box([0.065, 0.125, 0.02], 0.012, 1).moved([0.055, 0.0, 0.035]);
    let ear = |y: f64| rounded_box([0.06, 0.013, 0.032], 0.01, 1).moved([0.115, y, 0.05]);
    Mesh::of(&[neck, bar, ear(0.125), ear(-0.125)])
}

/// The head, broad and rounded.
pub(super) fn head_tilt() -> Mesh {
    let section = |x: f64, half: [f64; 2]| -> Vec<Vec3> {
        let outline = Profile::superellipse(half, 3.5, 24);
        outline.points().iter().map(|[y, z]| [x, *y, z + 0.012]).collect()
    };
    loft(&[
        section(-0.062, [0.06, 0.022]),
        section(-0.05, [0.085, 0.042]),
        section(-0.02, [0.1, 0.052]),
        section(0.03, [0.104, 0.053]),
        section(0.052, [0.1, 0.05]),
        section(0.058, [0.094, 0.044]),
    ])
}

/// The face: a dark pane with the cameras behind it.
pub(super) fn face() -> Mesh {
    let pane = rounded_box([0.004, 0.086, 0.026], 0.003, 1).moved([0.058, 0.0, 0.0225]);
    let lens = |y: f64| cylinder(0.013, [0.0, 0.006], 0.0, 12).along(X, [0.06, y, 0.0225]);
    Mesh::of(&[pane, lens(0.045), lens(-0.045), lens(0.0)])
}

/// The link that turns on the torso, and rises to the shoulder's drum.
pub(super) fn shoulder_pan() -> Mesh {
    let path = [
        ([0.0, 0.0, 0.035], 0.06),
        ([0.03, -0.008, 0.045], 0.06),
        ([0.07, -0.024, 0.055], 0.055),
        ([0.1, -0.034, 0.06], 0.05),
        ([0.117, -0.036, 0.06], 0.042),
    ];
    let column = cylinder(0.078, [-0.05, 0.06], 0.014, 24);
    column.with(&tube(&path)).with(&drum(0.058, 0.117, 0.06, [-0.068, -0.002]))
}

/// A link that flexes: its drum, and a tube as far as the next joint, which rolls.
fn flex(length: f64) -> Mesh {
    let path = [
        ([0.0, 0.034, 0.0], 0.04),
        ([0.02, 0.033, 0.0], 0.048),
        ([0.05, 0.022, 0.0], TUBE + 0.003),
        ([0.085, 0.006, 0.0], TUBE),
        ([0.11, 0.0, 0.0], TUBE),
        ([length - 0.003, 0.0, 0.0], TUBE),
    ];
    tube(&path).with(&drum(0.058, 0.0, 0.0, [0.002, 0.066]))
}

/// A link that rolls: a tube, and half of the next link's drum.
fn roll(length: f64) -> Mesh {
    let path = [
        ([0.001, 0.0, 0.0], TUBE - 0.004),
        ([0.012, 0.0, 0.0], TUBE),
        ([0.35 * length, -0.003, 0.0], TUBE),
        ([0.62 * length, -0.018, 0.0], TUBE + 0.002),
        ([length - 0.018, -0.033, 0.0], 0.048),
        ([length, -0.034, 0.0], 0.04),
    ];
    tube(&path).with(&drum(0.058, length, 0.0, [-0.066, -0.002]))
}

pub(super) fn shoulder_lift() -> Mesh {
    flex(0.219)
}

pub(super) fn upperarm_roll() -> Mesh {
    roll(0.133)
}

pub(super) fn elbow_flex() -> Mesh {
    flex(0.197)
}

pub(super) fn forearm_roll() -> Mesh {
    roll(0.1245)
}

pub(super) fn wrist_flex() -> Mesh {
    flex(0.1385)
}

/// The disc at the end of the arm, to which the gripper is screwed.
pub(super) fn wrist_roll() -> Mesh {
    cylinder(TUBE, [-0.002, 0.02], 0.005, ROUND).along(X, [0.0; 3])
}

/// The gripper's body.
pub(super) fn gripper() -> Mesh {
    let section = |x: f64, half: [f64; 2]| -> Vec<Vec3> {
        let outline = Profile::superellipse(half, 4.0, 24);
        outline.points().iter().map(|[y, z]| [x, *y, *z]).collect()
    };
    loft(&[
        section(-0.147, [0.044, 0.038]),
        section(-0.13, [0.054, 0.04]),
        section(-0.085, [0.0625, 0.0405]),
        section(-0.058, [0.0625, 0.039]),
        section(-0.052, [0.058, 0.034]),
    ])
}

/// The slot in which the fingers run.
pub(super) fn gripper_dark() -> Mesh {
    rounded_box([0.004, 0.056, 0.014], 0.002, 1).moved([-0.051, 0.0, 0.0])
}

/// The right finger; its pad is the plane y = -0.016.
pub(super) fn finger() -> Mesh {
    let carriage = rounded_box([0.009, 0.008, 0.013], 0.002, 1).moved([-0.044, -0.006, 0.0]);
    carriage.with(&rounded_box([0.034, 0.0065, 0.0125], 0.003, 1).moved([-0.004, -0.0085, 0.0]))
}

/// Its rubber.
pub(super) fn pad() -> Mesh {
    rounded_box([0.028, 0.0011, 0.0115], 0.0008, 1).moved([-0.001, -0.0149, 0.0])
}
