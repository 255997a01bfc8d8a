//! What the D'Claw, its gantry and its valve look like \[m\]. Fingers are made of the parts in `dynamixel.rs`, whose brackets are shorter
//! here than a leg's.

use crate::dynamixel;
use std::f64::consts::{FRAC_PI_2, TAU};
use workshop::{Mesh, Profile, Station, Vec3, cylinder, extrude, revolve, rounded_box, sweep};

/// By how much links are shorter than those of the parts \[m\].
const SHORTER: Vec3 = [0.0, 0.0, -0.0275];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// The round plate that carries the fingers, with a hole for cables and openings between the fingers.
pub(super) fn plate() -> Mesh {
    let opening = |turn: usize| {
        Profile::rounded_rectangle([0.011, 0.016], 0.008, 3)
            .moved([0.052, 0.0])
            .turned(TAU * turn as f64 / 3.0)
    };
    let holes = [Profile::circle(0.012, 14), opening(0), opening(1), opening(2)];
    extrude(&Profile::circle(0.0757, 48), &holes, [-0.003, 0.003])
}

pub(super) fn bracket() -> Mesh {
    dynamixel::bracket(0.027)
}

pub(super) fn clamp() -> Mesh {
    dynamixel::clamp().moved([0.0, 0.0, -0.0245])
}

pub(super) fn tip() -> Mesh {
    dynamixel::tip().moved(SHORTER)
}

pub(super) fn rubber() -> Mesh {
    dynamixel::rubber().moved(SHORTER)
}

/// A beam of the gantry, 30 x 30 mm and 0.4 m long, with a rail in the middle of each side.
pub(super) fn profile() -> Mesh {
    let beam = extrude(&Profile::rounded_rectangle([0.013, 0.013], 0.002, 1), &[], [0.0, 0.4]);
    let rail = |half: [f64; 2]| extrude(&Profile::rounded_rectangle(half, 0.0015, 1), &[], [0.0, 0.4]);
    beam.with(&rail([0.015, 0.0045])).with(&rail([0.0045, 0.015]))
}

/// The valve: three arms with round ends on a hub, above a stem.
pub(super) fn knob() -> Mesh {
    let section = Profile::superellipse([1.0, 1.0], 2.6, 14);
    let place = |y: f64, share: f64| Station { at: [0.0, y, 0.054], size: [0.021 * share, 0.02 * share] };
    let path = [
        place(0.0, 1.0),
        place(0.073, 1.0),
        place(0.083, 0.88),
        place(0.09, 0.64),
        place(0.0935, 0.36),
        place(0.0945, 0.0),
    ];
    let arm = |turn: usize| sweep(&section, &path).turned(Z, TAU * turn as f64 / 3.0);
    let hub = revolve(
        &[
            [0.0, 0.0],
            [0.02, 0.0],
            [0.02, 0.034],
            [0.032, 0.044],
            [0.032, 0.066],
            [0.026, 0.074],
            [0.0, 0.076],
        ],
        24,
    );
    Mesh::of(&[arm(0), arm(1), arm(2)]).with(&hub)
}

/// The plate below the valve, and the servo that measures its angle.
pub(super) fn foot() -> Mesh {
    let plate = rounded_box([0.04, 0.031, 0.005], 0.003, 1).moved([0.0125, 0.0, -0.005]);
    let servo = dynamixel::servo().turned([0.0, 1.0, 0.0], -FRAC_PI_2).moved([0.0, 0.0, 0.018]);
    let shaft = cylinder(0.0105, [0.034, 0.0385], 0.0, 14);
    plate.with(&servo).with(&shaft)
}
