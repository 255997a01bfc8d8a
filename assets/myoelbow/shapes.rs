//! Bones of a torso and its right arm, in the frames of their bodies \[m\]: x forward, y to the left, z up. The arm hangs down; its elbow
//! is 0.29 m below the shoulder. Sizes are those of an adult of 1.75 m, by eye.

use crate::bones::{knob, shaft};
use crate::hand;
use workshop::{Mesh, Vec3, cylinder, sincos};

/// Where the arm's frame is in the torso's \[m\].
const SHOULDER: Vec3 = [0.0, -0.17, 0.0];

/// Vertebrae, ribs and breastbone; the origin is between the shoulders.
pub(super) fn torso() -> Mesh {
    let mut parts = Vec::new();
    for level in 0..19 {
        let height = 0.145 - 0.032 * f64::from(level);
        let back = -0.075 - 0.02 * sincos(f64::from(level) * 0.35).0;
        parts.push(knob([0.017, 0.02, 0.014], [back, 0.0, height]));
        parts.push(knob([0.018, 0.006, 0.007], [back - 0.026, 0.0, height - 0.006]));
    }
    for rib in 0..9 {
        let number = f64::from(rib);
        let (top, wide) = (0.03 - 0.033 * number, 0.082 + 0.0085 * number.min(5.0) - 0.001 * number);
        let front = if rib < 7 { 1.0 } else { 0.55 - 0.1 * (number - 7.0) };
        let place = |step: i32| {
            let angle = f64::from(step) / 6.0 * std::f64::consts::PI * (0.5 + 0.5 * front);
            let (sine, cosine) = sincos(angle);
            let forward = -0.07 + (1.0 - cosine) * 0.5 * 0.16;
            ([forward, wide * sine + 0.012, top - 0.055 * angle / std::f64::consts::PI], [0.0045, 0.006])
        };
        let path: Vec<_> = (0..=6).map(place).collect();
        let side = shaft(&path);
        parts.push(side.clone().mirrored(1));
        parts.push(side);
    }
    parts.push(shaft(&[
        ([0.088, 0.0, 0.0], [0.02, 0.006]),
        ([0.098, 0.0, -0.07], [0.015, 0.005]),
        ([0.1, 0.0, -0.2], [0.016, 0.005]),
    ]));
    Mesh::of(&parts)
}

/// Cranium, eye sockets left out, and jaw.
pub(super) fn skull() -> Mesh {
    let cranium = knob([0.092, 0.072, 0.082], [-0.01, 0.0, 0.235]);
    let face = knob([0.05, 0.052, 0.065], [0.045, 0.0, 0.185]);
    let side = shaft(&[
        ([0.0, 0.055, 0.165], [0.01, 0.006]),
        ([0.02, 0.05, 0.13], [0.012, 0.007]),
        ([0.065, 0.025, 0.115], [0.012, 0.008]),
        ([0.078, 0.0, 0.113], [0.012, 0.009]),
    ]);
    Mesh::of(&[cranium, face, side.clone().mirrored(1), side])
}

/// Collarbone and shoulder blade of the right side.
pub(super) fn shoulder() -> Mesh {
    let collar = shaft(&[
        ([0.085, -0.015, 0.012], [0.009, 0.008]),
        ([0.09, -0.06, 0.022], [0.006, 0.006]),
        ([0.055, -0.11, 0.03], [0.0065, 0.006]),
        ([0.02, -0.155, 0.036], [0.008, 0.006]),
    ]);
    let blade = shaft(&[
        ([-0.09, -0.07, 0.03], [0.008, 0.004]),
        ([-0.09, -0.095, 0.005], [0.045, 0.004]),
        ([-0.092, -0.098, -0.05], [0.036, 0.0035]),
        ([-0.085, -0.085, -0.125], [0.01, 0.004]),
    ]);
    let spine = shaft(&[
        ([-0.098, -0.07, 0.0], [0.005, 0.006]),
        ([-0.08, -0.13, 0.025], [0.008, 0.007]),
        ([-0.02, -0.178, 0.037], [0.012, 0.006]),
    ]);
    let socket = shaft(&[([-0.07, -0.115, 0.005], [0.012, 0.012]), ([-0.028, -0.148, 0.0], [0.016, 0.02])]);
    let coracoid =
        shaft(&[([-0.035, -0.14, 0.012], [0.008, 0.008]), ([0.02, -0.143, 0.012], [0.006, 0.007])]);
    let frame = SHOULDER.map(|x| -x);
    Mesh::of(&[collar, blade, spine, socket, coracoid]).moved(frame)
}

/// Head, shaft, and the roller of the elbow.
pub(super) fn humerus() -> Mesh {
    let body = shaft(&[
        ([-0.003, 0.0, -0.005], [0.02, 0.021]),
        ([0.0, -0.003, -0.035], [0.0155, 0.016]),
        ([0.0, 0.0, -0.08], [0.0115, 0.012]),
        ([0.0, 0.0, -0.19], [0.01, 0.0105]),
        ([0.0, 0.0, -0.245], [0.0095, 0.016]),
        ([0.001, 0.0, -0.275], [0.0085, 0.027]),
    ]);
    let roller = cylinder(0.0125, [-0.024, 0.024], 0.005, 18).along([0.0, 1.0, 0.0], [0.0, 0.0, -0.29]);
    Mesh::of(&[body, knob([0.023, 0.022, 0.023], [-0.004, 0.012, 0.004]), roller])
}

/// From the hook behind the elbow to the side of the little finger.
pub(super) fn ulna() -> Mesh {
    let shank = shaft(&[
        ([-0.012, 0.008, -0.012], [0.011, 0.012]),
        ([-0.01, 0.009, -0.04], [0.0085, 0.0085]),
        ([-0.006, 0.014, -0.13], [0.0062, 0.0065]),
        hand::ULNA_END[0],
        hand::ULNA_END[1],
    ]);
    let hook = shaft(&[([-0.016, 0.004, -0.014], [0.009, 0.012]), ([-0.02, 0.004, 0.0], [0.0075, 0.011])]);
    shank.with(&hook)
}

/// From the outside of the elbow to the side of the thumb.
pub(super) fn radius() -> Mesh {
    let shank = shaft(&[
        ([0.003, -0.017, -0.02], [0.008, 0.008]),
        ([0.002, -0.014, -0.04], [0.0062, 0.0065]),
        ([0.004, -0.02, -0.12], [0.0065, 0.0065]),
        hand::RADIUS_END[0],
        hand::RADIUS_END[1],
    ]);
    shank.with(&knob([0.0105, 0.0105, 0.006], [0.003, -0.017, -0.017]))
}

/// Bones of the wrist, the palm and the fingers.
pub(super) fn hand() -> Mesh {
    let fingers = (0..4).flat_map(|number| hand::finger(number, &[0.2; 3]));
    let parts: Vec<Mesh> = hand::wrist().into_iter().chain(fingers).chain(hand::thumb()).collect();
    Mesh::of(&parts)
}

/// The cuffs of an elbow exoskeleton with their hinge, in the forearm's frame for a straight arm.
pub(super) fn cuff() -> Mesh {
    let ring = |height: f64, radius: f64| {
        let section = [
            [radius, -0.02],
            [radius + 0.005, -0.02],
            [radius + 0.005, 0.02],
            [radius, 0.02],
            [radius, -0.02],
        ];
        workshop::revolve(&section, 28).moved([0.0, 0.0, height])
    };
    let bar = shaft(&[([0.0, -0.05, 0.0], [0.009, 0.004]), ([0.0, -0.046, -0.16], [0.009, 0.004])]);
    let motor = cylinder(0.026, [-0.075, -0.048], 0.003, 24).along([0.0, 1.0, 0.0], [0.0; 3]);
    Mesh::of(&[ring(-0.14, 0.04), bar, motor])
}
