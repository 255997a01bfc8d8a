//! What the links of the Panda look like, each in the frame of its body \[m\]. White shells end in drums round the joints; caps, rings
//! and fingers are dark. Widths are judged from photographs: only the places of the joints are the maker's.

use crate::arms;
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, rounded_box};

/// Steps round a drum.
const ROUND: usize = 20;
/// Radius of the drums of joints 1 to 4 \[m\].
const DRUM: f64 = 0.061;
/// Radius of the tubes between them \[m\].
const TUBE: f64 = 0.054;

fn tube(path: &[(Vec3, [f64; 2])]) -> Mesh {
    arms::tube(path, ROUND)
}

fn drum(radius: f64, axis: Vec3, centre: Vec3, heights: [f64; 2]) -> Mesh {
    arms::drum(radius, axis, centre, heights, ROUND)
}

/// A dark disc on the end of a drum.
fn disc(radius: f64, axis: Vec3, centre: Vec3, [low, high]: [f64; 2]) -> Mesh {
    cylinder(radius, [low, high], 0.0, ROUND).along(axis, centre)
}

const Y: Vec3 = [0.0, 1.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// The foot with its connector box behind, and the column of joint 1.
pub(super) fn base() -> Mesh {
    let foot = |scale: f64, height: f64| -> Vec<Vec3> {
        let outline = Profile::link([0.09 * scale, 0.075 * scale], 0.13, 10);
        outline.points().iter().map(|[x, y]| [0.055 - x, *y, height]).collect()
    };
    let rings = [(1.0, 0.012), (1.0, 0.03), (0.94, 0.055), (0.8, 0.1), (0.74, 0.125), (0.66, 0.138)];
    let rings: Vec<_> = rings.iter().map(|(scale, height)| foot(*scale, *height)).collect();
    let turned: Vec<Vec<Vec3>> = rings.into_iter().map(|ring| ring.into_iter().rev().collect()).collect();
    workshop::loft(&turned).with(&cylinder(0.062, [0.1, 0.141], 0.004, ROUND))
}

/// The plate under the foot, and the ring where link 1 turns.
pub(super) fn base_dark() -> Mesh {
    let plate = Profile::link([0.092, 0.078], 0.13, 10).turned(std::f64::consts::PI).moved([0.055, 0.0]);
    extrude(&plate, &[], [0.0, 0.012]).with(&cylinder(0.056, [0.138, 0.146], 0.001, ROUND))
}

/// The column up to the shoulder, half of whose drum it carries.
pub(super) fn link1() -> Mesh {
    let column = [
        ([0.0, 0.0, -0.191], [0.0595; 2]),
        ([0.0, 0.0, -0.12], [0.0595; 2]),
        ([0.0, -0.008, -0.075], [0.058, 0.056]),
        ([0.0, -0.025, -0.03], [0.058, 0.048]),
        ([0.0, -0.032, 0.0], [0.057, 0.04]),
    ];
    tube(&column).with(&drum(DRUM, Y, [0.0; 3], [-0.078, -0.002]))
}

/// The other half of the shoulder, and the upper arm's lower part. The frame's y axis points down the arm.
pub(super) fn link2() -> Mesh {
    let column = [
        ([0.0, 0.0, 0.032], [0.057, 0.04]),
        ([0.0, -0.03, 0.025], [0.058, 0.048]),
        ([0.0, -0.075, 0.008], [0.058, 0.056]),
        ([0.0, -0.1, 0.0], [TUBE + 0.005; 2]),
        ([0.0, -0.125, 0.0], [TUBE + 0.005; 2]),
    ];
    tube(&column).with(&drum(DRUM, Z, [0.0; 3], [0.002, 0.078]))
}

/// The upper arm's upper part, bent forward to the elbow.
pub(super) fn link3() -> Mesh {
    let column = [
        ([0.0, 0.0, -0.188], [TUBE + 0.005; 2]),
        ([0.0, 0.0, -0.12], [TUBE; 2]),
        ([0.008, 0.0, -0.08], [TUBE, 0.056]),
        ([0.035, 0.012, -0.045], [0.052, 0.055]),
        ([0.062, 0.025, -0.018], [0.05, 0.046]),
        ([0.0825, 0.032, 0.0], [0.045, 0.04]),
    ];
    tube(&column).with(&drum(DRUM - 0.003, Y, [0.0825, 0.0, 0.0], [0.002, 0.07]))
}

pub(super) fn link3_dark() -> Mesh {
    disc(0.038, Y, [0.0825, 0.0, 0.0], [0.068, 0.074])
}

/// The elbow's other half, bent back to the forearm.
pub(super) fn link4() -> Mesh {
    let column = [
        ([0.0, 0.0, 0.032], [0.045, 0.04]),
        ([-0.02, 0.018, 0.025], [0.05, 0.046]),
        ([-0.048, 0.045, 0.012], [0.052, 0.055]),
        ([-0.0745, 0.08, 0.0], [TUBE, 0.056]),
        ([-0.0825, 0.105, 0.0], [TUBE + 0.003; 2]),
        ([-0.0825, 0.122, 0.0], [TUBE + 0.003; 2]),
    ];
    tube(&column).with(&drum(DRUM - 0.003, Z, [0.0; 3], [0.002, 0.07]))
}

pub(super) fn link4_dark() -> Mesh {
    disc(0.038, Z, [0.0; 3], [0.068, 0.074])
}

/// The forearm: round at the elbow, then a slim bow over the wrist.
pub(super) fn link5() -> Mesh {
    let path = [
        ([0.0, 0.0, -0.258], [TUBE + 0.003; 2]),
        ([0.0, 0.0, -0.215], [TUBE + 0.001; 2]),
        ([0.0, 0.014, -0.185], [0.053, 0.052]),
        ([0.0, 0.045, -0.14], [0.05, 0.04]),
        ([0.0, 0.07, -0.09], [0.046, 0.03]),
        ([0.0, 0.08, -0.04], [0.043, 0.027]),
        ([0.0, 0.076, 0.0], [0.042, 0.027]),
        ([0.0, 0.068, 0.03], [0.036, 0.024]),
    ];
    tube(&path).with(&drum(0.05, Y, [0.0; 3], [0.036, 0.082]))
}

/// The ring below the elbow.
pub(super) fn link5_dark() -> Mesh {
    disc(TUBE - 0.001, Z, [0.0; 3], [-0.264, -0.256])
}

/// The wrist's drum, and the neck that carries the flange.
pub(super) fn link6() -> Mesh {
    let neck = [
        ([0.0, 0.0, -0.005], [0.044, 0.04]),
        ([0.045, 0.0, 0.0], [0.046, 0.04]),
        ([0.088, 0.0, 0.0], [0.05, 0.046]),
    ];
    let sleeve = cylinder(0.05, [-0.052, 0.05], 0.012, ROUND).along(Y, [0.088, 0.0, 0.0]);
    drum(0.05, Z, [0.0; 3], [-0.045, 0.034]).with(&tube(&neck)).with(&sleeve)
}

pub(super) fn link6_dark() -> Mesh {
    disc(0.036, Z, [0.0; 3], [-0.05, -0.043])
}

/// The last sleeve, with the pilot's panel beside it.
pub(super) fn link7() -> Mesh {
    let sleeve = cylinder(0.045, [0.052, 0.088], 0.004, ROUND);
    let turn = std::f64::consts::FRAC_PI_4;
    let panel = rounded_box([0.03, 0.03, 0.016], 0.01, 3).moved([0.05, 0.0, 0.07]).turned(Z, turn);
    sleeve.with(&panel)
}

/// The flange, and the panel's buttons.
pub(super) fn link7_dark() -> Mesh {
    let turn = std::f64::consts::FRAC_PI_4;
    let buttons = cylinder(0.017, [0.084, 0.089], 0.001, 20).moved([0.055, 0.0, 0.0]).turned(Z, turn);
    cylinder(0.0315, [0.086, 0.107], 0.002, ROUND).with(&buttons)
}

/// The gripper's body: broad, flat, tapered towards the fingers.
pub(super) fn hand() -> Mesh {
    let section = |half: [f64; 2], height: f64| -> Vec<Vec3> {
        let outline = Profile::rounded_rectangle(half, 0.022, 5);
        outline.points().iter().map(|[x, y]| [*x, *y, height]).collect()
    };
    let sections = [
        ([0.026, 0.06], 0.004),
        ([0.03, 0.085], 0.014),
        ([0.0315, 0.1], 0.03),
        ([0.0315, 0.102], 0.045),
        ([0.03, 0.101], 0.058),
        ([0.027, 0.097], 0.064),
    ];
    workshop::loft(&sections.map(|(half, height)| section(half, height))).with(&cylinder(
        0.04,
        [0.0, 0.012],
        0.002,
        ROUND,
    ))
}

/// The slot in which the fingers run.
pub(super) fn hand_dark() -> Mesh {
    rounded_box([0.014, 0.088, 0.004], 0.003, 2).moved([0.0, 0.0, 0.0635])
}

/// A finger: its carriage, and the blade that leans inwards. The pad's face is the plane y = 0.
pub(super) fn finger() -> Mesh {
    let carriage = rounded_box([0.0105, 0.0105, 0.009], 0.003, 2).moved([0.0, 0.0135, 0.009]);
    let side = Profile::polygon(&[
        [0.004, 0.012],
        [0.024, 0.012],
        [0.021, 0.03],
        [0.013, 0.04],
        [0.0125, 0.0535],
        [0.0045, 0.0535],
        [0.0045, 0.036],
        [0.008, 0.028],
    ]);
    // Drawn in the plane of y and z, as thick as the finger is wide.
    let blade = extrude(&side, &[], [-0.0095, 0.0095]).mapped(|[y, z, x]| [x, y, z]);
    carriage.with(&blade)
}

/// The rubber at the end.
pub(super) fn fingertip() -> Mesh {
    rounded_box([0.0088, 0.0042, 0.0092], 0.0015, 2).moved([0.0, 0.0042, 0.0445])
}
