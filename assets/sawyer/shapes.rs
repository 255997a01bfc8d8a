//! What the links of the Sawyer look like, each in the frame of its body \[m\]: red shells in bows from joint to joint, dark caps, a
//! screen with eyes. Widths keep to the capsules that collide.

use crate::arms::{drum, tube};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, revolve, rounded_box};

/// Steps round a tube.
const ROUND: usize = 12;
const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// A flat disc about an axis through `centre`, between two heights along it.
fn disc(radius: f64, axis: Vec3, centre: Vec3, heights: [f64; 2]) -> Mesh {
    cylinder(radius, heights, 0.0, ROUND).along(axis, centre)
}

/// The foot that is screwed to a pedestal.
pub(super) fn base() -> Mesh {
    let line = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.012], [0.088, 0.02], [0.082, 0.08], [0.0, 0.08]];
    revolve(&line, 16)
}

/// The column, and its arm to the shoulder, half of whose drum it carries.
pub(super) fn link0() -> Mesh {
    let column = revolve(
        &[
            [0.0, 0.004],
            [0.082, 0.004],
            [0.085, 0.02],
            [0.082, 0.2],
            [0.07, 0.25],
            [0.052, 0.268],
            [0.0, 0.27],
        ],
        16,
    );
    let arm = [
        ([0.0, -0.01, 0.12], [0.06, 0.05]),
        ([0.04, -0.022, 0.18], [0.062, 0.044]),
        ([0.081, -0.03, 0.237], [0.056, 0.036]),
    ];
    let shoulder = drum(0.07, Y, [0.081, 0.0, 0.237], [-0.068, -0.012], ROUND);
    Mesh::of([&column, &tube(&arm, ROUND), &shoulder])
}

/// The ring where the column turns, the cap of the shoulder, and the head's neck.
pub(super) fn link0_dark() -> Mesh {
    Mesh::of([
        &disc(0.079, Z, [0.0; 3], [-0.004, 0.006]),
        &disc(0.048, Y, [0.081, 0.0, 0.237], [-0.074, -0.066]),
        &disc(0.042, Z, [0.0; 3], [0.266, 0.3]),
    ])
}

/// The frame of the screen on its neck.
pub(super) fn head() -> Mesh {
    let neck = [
        ([0.0, 0.0, -0.005], [0.038, 0.038]),
        ([0.0, 0.0, 0.03], [0.034, 0.034]),
        ([0.012, 0.0, 0.075], [0.022, 0.036]),
    ];
    let frame = Profile::rounded_rectangle([0.13, 0.08], 0.018, 3);
    let frame = extrude(&frame, &[], [0.012, 0.037]).mapped(|[y, z, x]| [x, y, z + 0.1]);
    tube(&neck, ROUND).with(&frame)
}

/// A flat figure on the screen, from `low` to `high` before it.
fn shown(figure: &Profile, [low, high]: [f64; 2]) -> Mesh {
    extrude(figure, &[], [low, high]).mapped(|[y, z, x]| [x, y, z + 0.1])
}

pub(super) fn screen() -> Mesh {
    let pupil = |side: f64| shown(&Profile::circle(0.011, 10).moved([side * 0.042, 0.004]), [0.0385, 0.0405]);
    let glass = shown(&Profile::rounded_rectangle([0.118, 0.068], 0.01, 2), [0.036, 0.0382]);
    Mesh::of([&glass, &pupil(-1.0), &pupil(1.0)])
}

pub(super) fn eyes() -> Mesh {
    let eye =
        |side: f64| shown(&Profile::ellipse([0.026, 0.03], 14).moved([side * 0.045, 0.008]), [0.038, 0.0395]);
    eye(-1.0).with(&eye(1.0))
}

/// The shoulder: a drum, bent to the upper arm.
pub(super) fn link1() -> Mesh {
    let bow = [
        ([0.0, 0.0, 0.0], [0.066, 0.066]),
        ([0.0, 0.0, 0.075], [0.066, 0.066]),
        ([0.0, -0.018, 0.115], [0.064, 0.064]),
        ([0.0, -0.06, 0.138], [0.062, 0.058]),
        ([0.0, -0.135, 0.1425], [0.06, 0.056]),
    ];
    drum(0.07, Z, [0.0; 3], [-0.06, 0.05], ROUND).with(&tube(&bow, ROUND))
}

/// The ring where the upper arm turns.
pub(super) fn link1_dark() -> Mesh {
    disc(0.054, Y, [0.0, -0.14, 0.1425], [-0.004, 0.01]).with(&disc(0.045, Z, [0.0; 3], [-0.064, -0.058]))
}

/// The upper arm, and half of the elbow's drum.
pub(super) fn link2() -> Mesh {
    let arm = [
        ([0.0, 0.0, 0.004], [0.06, 0.056]),
        ([0.0, 0.0, 0.07], [0.056, 0.053]),
        ([0.0, 0.0, 0.18], [0.05, 0.048]),
        ([0.0, 0.002, 0.225], [0.05, 0.044]),
        ([0.0, 0.004, 0.26], [0.048, 0.036]),
    ];
    tube(&arm, ROUND).with(&drum(0.056, Y, [0.0, 0.0, 0.26], [-0.028, 0.042], ROUND))
}

pub(super) fn link2_dark() -> Mesh {
    disc(0.038, Y, [0.0, 0.0, 0.26], [0.04, 0.048]).with(&disc(0.0515, Y, [0.0, 0.0, 0.26], [-0.034, -0.026]))
}

/// The elbow's other half, bent to the forearm.
pub(super) fn link3() -> Mesh {
    let bow = [
        ([0.0, 0.0, -0.02], [0.054, 0.054]),
        ([0.0, 0.0, -0.07], [0.054, 0.054]),
        ([0.0, -0.016, -0.106], [0.052, 0.052]),
        ([0.0, -0.055, -0.124], [0.05, 0.048]),
        ([0.0, -0.12, -0.1265], [0.049, 0.046]),
    ];
    drum(0.056, Z, [0.0; 3], [-0.06, 0.01], ROUND).with(&tube(&bow, ROUND))
}

/// The ring where the forearm turns.
pub(super) fn link3_dark() -> Mesh {
    disc(0.0445, Y, [0.0, -0.125, -0.1265], [-0.004, 0.008])
}

/// The forearm, and half of the wrist's drum.
pub(super) fn link4() -> Mesh {
    let arm = [
        ([0.0, 0.0, 0.004], [0.049, 0.046]),
        ([0.0, 0.0, 0.08], [0.045, 0.043]),
        ([0.0, 0.0, 0.2], [0.041, 0.039]),
        ([0.0, 0.0, 0.245], [0.04, 0.036]),
        ([0.0, -0.004, 0.275], [0.038, 0.03]),
    ];
    tube(&arm, ROUND).with(&drum(0.046, Y, [0.0, 0.0, 0.275], [-0.038, 0.014], ROUND))
}

pub(super) fn link4_dark() -> Mesh {
    disc(0.03, Y, [0.0, 0.0, 0.275], [-0.044, -0.036]).with(&disc(
        0.042,
        Y,
        [0.0, 0.0, 0.275],
        [0.012, 0.019],
    ))
}

/// The wrist's other half, bent to the flange.
pub(super) fn link5() -> Mesh {
    let bow = [
        ([0.0, 0.0, 0.0], [0.044, 0.044]),
        ([0.0, 0.0, 0.055], [0.044, 0.044]),
        ([0.0, -0.014, 0.088], [0.044, 0.044]),
        ([0.0, -0.045, 0.103], [0.045, 0.043]),
        ([0.0, -0.084, 0.1053], [0.046, 0.044]),
    ];
    drum(0.046, Z, [0.0; 3], [-0.012, 0.05], ROUND).with(&tube(&bow, ROUND))
}

/// The panel of the cuff, with its buttons.
pub(super) fn link5_dark() -> Mesh {
    let panel = rounded_box([0.018, 0.02, 0.006], 0.004, 1).moved([0.0, -0.045, 0.146]);
    panel.with(&disc(0.038, Y, [0.0, -0.084, 0.1053], [-0.006, 0.004]))
}

/// The cuff's end and the flange.
pub(super) fn link6() -> Mesh {
    let line =
        [[0.0, -0.018], [0.044, -0.018], [0.045, 0.008], [0.036, 0.016], [0.033, 0.0245], [0.0, 0.0245]];
    revolve(&line, ROUND)
}

/// The gripper's case, on a round adapter.
pub(super) fn gripper() -> Mesh {
    let case = rounded_box([0.026, 0.058, 0.024], 0.008, 2).moved([0.0, 0.0, 0.04]);
    cylinder(0.031, [0.0, 0.02], 0.0, ROUND).with(&case)
}

/// The slot in which the fingers run, and a lid on either side.
pub(super) fn gripper_dark() -> Mesh {
    let slot = rounded_box([0.012, 0.05, 0.003], 0.002, 1).moved([0.0, 0.0, 0.064]);
    let lid = |side: f64| {
        extrude(&Profile::rounded_rectangle([0.036, 0.014], 0.004, 1), &[], [-0.001, 0.001])
            .mapped(|[y, z, x]| [x, y, z])
            .moved([side * 0.0258, 0.0, 0.04])
    };
    Mesh::of([&slot, &lid(-1.0), &lid(1.0)])
}

/// A finger: its carriage in the slot, and the blade that stands inwards. The pad's face is the plane y = 0.
pub(super) fn finger() -> Mesh {
    let side = Profile::polygon(&[
        [0.006, -0.006],
        [0.024, -0.006],
        [0.024, 0.008],
        [0.018, 0.024],
        [0.0165, 0.078],
        [0.0125, 0.081],
        [0.0072, 0.081],
        [0.0072, 0.02],
        [0.006, 0.012],
    ]);
    extrude(&side, &[], [-0.01, 0.01]).mapped(|[y, z, x]| [x, y, z])
}

/// The rubber, and the screw that holds the finger.
pub(super) fn pad() -> Mesh {
    let rubber = rounded_box([0.01, 0.004, 0.016], 0.001, 1).moved([0.0, 0.004, 0.065]);
    rubber.with(&cylinder(0.0035, [-0.0112, 0.0112], 0.0, 8).along(X, [0.0, 0.0165, 0.004]))
}
