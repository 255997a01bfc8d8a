//! What the links of the MPL look like, each in the frame of its body \[m\]: the hanging arm points along -y, the palm faces -z, the
//! thumb points along x. Shells are pale barrels, joints dark or metal, fingertips rubber.

use crate::arms::{drum, tube};
use crate::fingers::{bar, plate};
use std::f64::consts::FRAC_PI_2;
use workshop::{Mesh, Profile, Vec3, cylinder, revolve, rounded_box};

/// Steps round a tube of the arm.
const ROUND: usize = 10;
const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// A flat disc about an axis through `centre`, `half` to either side, in `count` steps round.
fn disc(radius: f64, axis: Vec3, centre: Vec3, half: f64, count: usize) -> Mesh {
    cylinder(radius, [-half, half], 0.0, count).along(axis, centre)
}

/// A part drawn along z with the palm towards -y, laid along -y with the palm towards -z.
fn hanging(part: Mesh) -> Mesh {
    part.turned(X, FRAC_PI_2)
}

/// The socket at the body, which is on the side of y here.
pub(super) fn mount() -> Mesh {
    let line = [[0.0, 0.046], [0.04, 0.046], [0.05, 0.056], [0.052, 0.104], [0.0, 0.104]];
    revolve(&line, 14).along(Y, [0.0; 3])
}

/// The plate that is screwed to the body, and the joint's neck.
pub(super) fn mount_dark() -> Mesh {
    disc(0.046, Y, [0.0, 0.112, 0.0], 0.008, 12).with(&disc(0.03, Y, [0.0, 0.043, 0.0], 0.005, 10))
}

/// The cross of the first two joints of the shoulder.
pub(super) fn shoulder() -> Mesh {
    drum(0.036, Z, [0.0; 3], [-0.04, 0.03], ROUND).with(&drum(0.026, X, [0.0; 3], [-0.049, 0.049], ROUND))
}

/// The barrel of the upper arm, and the cap over the shoulder.
pub(super) fn humerus_upper() -> Mesh {
    let path = [
        ([0.0, 0.036, 0.018], [0.022, 0.018]),
        ([0.0, 0.022, 0.024], [0.046, 0.028]),
        ([0.0, -0.02, 0.026], [0.053, 0.034]),
        ([0.0, -0.05, 0.016], [0.051, 0.047]),
        ([0.0, -0.11, 0.014], [0.0495, 0.0475]),
        ([0.0, -0.146, 0.014], [0.0455, 0.0435]),
    ];
    tube(&path, ROUND)
}

/// The ring where the upper arm turns, and the motor's lid.
pub(super) fn humerus_upper_dark() -> Mesh {
    let lid = rounded_box([0.022, 0.03, 0.004], 0.003, 1).moved([0.0, -0.078, 0.062]);
    disc(0.041, Y, [0.0, -0.149, 0.0139], 0.005, 12).with(&lid)
}

/// The lower part of the upper arm, down to the elbow.
pub(super) fn humerus_lower() -> Mesh {
    let path = [
        ([0.0, -0.004, 0.0], [0.045, 0.043]),
        ([0.0, -0.05, 0.0], [0.044, 0.0415]),
        ([0.002, -0.095, 0.0], [0.04, 0.034]),
        ([0.006, -0.125, 0.0], [0.034, 0.024]),
        ([0.01, -0.158, 0.0], [0.028, 0.018]),
    ];
    tube(&path, ROUND)
}

/// The caps of the elbow.
pub(super) fn humerus_lower_dark() -> Mesh {
    drum(0.031, Z, [0.01, -0.1444, 0.0], [-0.049, 0.049], ROUND)
}

/// The barrel of the forearm, its cheeks round the elbow.
pub(super) fn forearm() -> Mesh {
    let path = [
        ([0.0, -0.012, 0.0], [0.032, 0.044]),
        ([0.0, -0.034, 0.0], [0.047, 0.05]),
        ([0.0, -0.085, 0.0], [0.05, 0.05]),
        ([0.0, -0.145, 0.0], [0.044, 0.0445]),
        ([0.0, -0.182, 0.0], [0.0385, 0.0385]),
    ];
    let cheek = |side: f64| disc(0.035, Z, [0.0, 0.0, side * 0.038], 0.0075, ROUND);
    Mesh::of([&tube(&path, ROUND), &cheek(-1.0), &cheek(1.0)])
}

/// A band round the forearm, and a lid on it.
pub(super) fn forearm_dark() -> Mesh {
    let lid = rounded_box([0.02, 0.034, 0.004], 0.003, 1).moved([0.0, -0.095, 0.0485]);
    disc(0.0395, Y, [0.0, -0.184, 0.0], 0.004, 12).with(&lid)
}

/// The wrist's rotor.
pub(super) fn wrist_rot() -> Mesh {
    let line = [[0.0, 0.002], [0.037, 0.002], [0.037, 0.02], [0.026, 0.034], [0.022, 0.044], [0.0, 0.044]];
    revolve(&line, 12).along([0.0, -1.0, 0.0], [0.0; 3])
}

/// The block between the last two joints of the wrist.
pub(super) fn wrist_dev() -> Mesh {
    let block = bar(&[(0.0, [0.013, 0.016], 0.0), (0.03, [0.013, 0.013], 0.0)], 0.004, 1);
    disc(0.015, Z, [0.0; 3], 0.021, ROUND).with(&hanging(block))
}

pub(super) fn wrist_fe() -> Mesh {
    disc(0.0135, X, [0.0; 3], 0.023, ROUND)
}

/// The shell of the palm, whose outline is drawn in x and along the hand.
pub(super) fn palm() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.045, 0.004],
        [-0.006, 0.004],
        [0.012, 0.013],
        [0.0185, 0.03],
        [0.0185, 0.064],
        [0.002, 0.067],
        [-0.003, 0.076],
        [-0.023, 0.076],
        [-0.027, 0.067],
        [-0.046, 0.064],
        [-0.05, 0.055],
        [-0.066, 0.051],
        [-0.069, 0.03],
        [-0.062, 0.013],
    ]);
    hanging(plate(&outline, [-0.0125, 0.0145], 0.003))
}

/// The plate on the back of the hand, and the housing of the thumb's motor.
pub(super) fn palm_dark() -> Mesh {
    let back =
        Profile::polygon(&[[-0.056, 0.016], [0.006, 0.016], [0.01, 0.03], [0.008, 0.058], [-0.056, 0.048]]);
    let motor = disc(0.0125, Y, [0.0075, -0.0205, -0.0095], 0.0125, ROUND);
    hanging(plate(&back, [0.012, 0.0175], 0.0018)).with(&motor)
}

/// Pads below the fingers and at the heel of the hand.
pub(super) fn palm_pads() -> Mesh {
    let pad = |half: [f64; 2], [x, y]: [f64; 2]| {
        rounded_box([half[0], half[1], 0.0035], 0.0028, 1).moved([x, y, -0.0135])
    };
    pad([0.031, 0.0115], [-0.022, -0.054]).with(&pad([0.0165, 0.0155], [-0.043, -0.023]))
}

/// A link of a finger along z, from its joint to where the next one begins.
fn phalanx(length: f64, [wide, deep]: [f64; 2]) -> Mesh {
    bar(
        &[
            (0.003, [0.74 * wide, 0.72 * deep], 0.0),
            (0.0085, [wide, deep], 0.0),
            (length - 0.008, [0.96 * wide, 0.92 * deep], 0.0),
            (length - 0.003, [0.72 * wide, 0.66 * deep], 0.0),
        ],
        0.003,
        1,
    )
}

/// The last link along z: full on the side of the palm, round at its end.
fn fingertip(length: f64, [wide, deep]: [f64; 2]) -> Mesh {
    bar(
        &[
            (0.0025, [0.74 * wide, 0.72 * deep], 0.0),
            (0.008, [wide, deep], 0.0),
            (0.66 * length, [0.96 * wide, 0.94 * deep], 0.0),
            (0.9 * length, [0.7 * wide, 0.68 * deep], 0.0004),
            (length, [0.3 * wide, 0.3 * deep], 0.0008),
        ],
        0.003,
        1,
    )
}

/// The root of a finger, which leans to the side.
pub(super) fn knuckle() -> Mesh {
    let root = bar(&[(-0.006, [0.0062, 0.0078], 0.0), (0.012, [0.0072, 0.0072], 0.0)], 0.003, 1);
    hanging(root)
}

pub(super) fn proximal() -> Mesh {
    hanging(phalanx(0.0435, [0.0086, 0.0086]))
}

pub(super) fn medial() -> Mesh {
    hanging(phalanx(0.0245, [0.0081, 0.0081]))
}

pub(super) fn distal() -> Mesh {
    hanging(fingertip(0.0252, [0.0077, 0.0076])).moved([0.0, 0.0, 0.0006])
}

pub(super) fn little_proximal() -> Mesh {
    hanging(phalanx(0.033, [0.0082, 0.0082]))
}

pub(super) fn little_medial() -> Mesh {
    hanging(phalanx(0.0175, [0.0078, 0.0078]))
}

/// The pin of a finger's joint.
pub(super) fn digit_joint() -> Mesh {
    disc(0.0068, X, [0.0; 3], 0.0082, 8)
}

/// A part drawn along z with its pad towards -y, laid along x.
fn pointing(part: Mesh) -> Mesh {
    part.turned(Y, FRAC_PI_2)
}

/// The thumb's root, which swings about the hand's long axis.
pub(super) fn thumb_root() -> Mesh {
    pointing(bar(&[(0.0, [0.0085, 0.0105], 0.0), (0.017, [0.0085, 0.0085], 0.0)], 0.003, 1))
}

pub(super) fn thumb_proximal() -> Mesh {
    pointing(phalanx(0.0335, [0.0096, 0.0096]))
}

pub(super) fn thumb_medial() -> Mesh {
    pointing(phalanx(0.0335, [0.0092, 0.0091]))
}

pub(super) fn thumb_distal() -> Mesh {
    pointing(fingertip(0.031, [0.0088, 0.0086]))
}

/// The pin of a thumb's joint.
pub(super) fn thumb_joint() -> Mesh {
    disc(0.0076, Z, [0.0; 3], 0.0092, 8)
}
