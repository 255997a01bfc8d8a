//! What the palm and the brackets of D'Manus look like \[m\], z towards the fingers, which bend to -y. Servos and tips are those of
//! `dynamixel.rs`, whose brackets are shorter here than a leg's.

use crate::dynamixel;
use std::f64::consts::FRAC_PI_2;
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, rounded_box};

/// By how much links are shorter than those of the parts \[m\].
const SHORTER: Vec3 = [0.0, 0.0, -0.0275];
const X: Vec3 = [1.0, 0.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// The plate on the arm's flange.
pub(super) fn mount() -> Mesh {
    cylinder(0.0315, [0.0, 0.01], 0.001, 24)
}

/// A plate of an outline in the plane of x and z, between two places along y.
fn upright(outline: &Profile, holes: &[Profile], [low, high]: [f64; 2]) -> Mesh {
    extrude(outline, holes, [-high, -low]).turned(X, FRAC_PI_2)
}

/// Front and back of the palm: plates that widen to the knuckles, with the screws' holes and windows between the servos.
pub(super) fn palm() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.034, 0.0],
        [0.034, 0.0],
        [0.048, 0.012],
        [0.053, 0.03],
        [0.064, 0.052],
        [0.067, 0.066],
        [0.067, 0.09],
        [0.06, 0.1],
        [0.03, 0.1],
        [0.022, 0.094],
        [0.016, 0.078],
        [-0.016, 0.078],
        [-0.022, 0.094],
        [-0.03, 0.1],
        [-0.06, 0.1],
        [-0.067, 0.09],
        [-0.067, 0.066],
        [-0.064, 0.052],
        [-0.053, 0.03],
        [-0.048, 0.012],
    ]);
    let horn = |x: f64, z: f64| Profile::circle(0.0075, 12).moved([x, z]);
    let window = Profile::rounded_rectangle([0.012, 0.018], 0.005, 2).moved([0.0, 0.042]);
    let holes = [horn(0.0445, 0.084), horn(-0.0445, 0.084), window];
    upright(&outline, &holes, [-0.0275, -0.0235]).with(&upright(&outline, &holes, [0.0215, 0.0255]))
}

/// What stands between the plates: the block on the mount, and the case of the electronics.
pub(super) fn core() -> Mesh {
    let block = rounded_box([0.032, 0.0222, 0.009], 0.003, 2).moved([0.0, -0.001, 0.0095]);
    block.with(&rounded_box([0.02, 0.02, 0.0245], 0.003, 2).moved([0.0, -0.001, 0.045]))
}

/// The bracket on the sideways servo, which carries the next one across.
pub(super) fn knuckle() -> Mesh {
    let plate = rounded_box([0.0165, 0.0215, 0.0015], 0.001, 1).moved([0.0, 0.002, 0.0205]);
    dynamixel::bracket(0.019).turned(Z, FRAC_PI_2).with(&plate)
}

pub(super) fn bracket() -> Mesh {
    dynamixel::bracket(0.0165)
}

pub(super) fn tip() -> Mesh {
    dynamixel::tip()
        .moved(SHORTER)
        .with(&rounded_box([0.0215, 0.013, 0.006], 0.001, 1).moved([0.0, 0.0, 0.023]))
}

pub(super) fn rubber() -> Mesh {
    dynamixel::rubber().moved(SHORTER)
}
