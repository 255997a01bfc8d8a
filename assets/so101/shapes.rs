//! What the parts of the SO-101 look like \[m\]: printed plastic round black servos. Links are in the frames of their bodies, whose axes
//! are the base's when all joints are at 0: forward x, left y, up z. The places of servos are the maker's; outlines are judged from
//! photographs.

use crate::shape::{block, side};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude};

/// Half the width of a servo between its horns, and of the cheeks round it \[m\].
const HORN: f64 = 0.0187;
/// Thickness of printed cheeks \[m\].
const CHEEK: f64 = 0.0045;
const Y: Vec3 = [0.0, 1.0, 0.0];

/// The convex outline of two circles, the first at the origin, seen along y.
fn bar(to: [f64; 2], radii: [f64; 2]) -> Profile {
    Profile::link(radii, to[0].hypot(to[1]), 6).turned(to[1].atan2(to[0]))
}

/// Two cheeks on the horns of the servo at the origin, whose middle is at `y`, towards `to`.
fn fork(to: [f64; 2], radii: [f64; 2], y: f64) -> Mesh {
    let outline = bar(to, radii);
    side(&outline, [y - HORN - CHEEK, y - HORN]).with(&side(&outline, [y + HORN, y + HORN + CHEEK]))
}

/// An STS3215, 45 x 25 x 35 mm, with its long side along x: case and gear box, its shaft 12.5 mm before the middle along z.
pub(super) fn servo() -> Mesh {
    let case = block([-0.0226, -0.01235, -0.0175], [0.0226, 0.01235, 0.009], 0.0015);
    let gears = block([-0.0218, -0.0117, 0.008], [0.0218, 0.0117, 0.0165], 0.0015);
    case.with(&gears)
}

/// The horns on both ends of a servo's shaft.
pub(super) fn horns() -> Mesh {
    cylinder(0.01, [-HORN - 0.001, HORN + 0.001], 0.0, 12).moved([0.0125, 0.0, 0.0])
}

/// The foot with its wide plate for clamps, and the tower round the first servo.
pub(super) fn base() -> Mesh {
    let plate = Profile::polygon(&[
        [-0.066, -0.052],
        [-0.048, -0.055],
        [0.02, -0.055],
        [0.038, -0.034],
        [0.058, -0.02],
        [0.058, 0.02],
        [0.038, 0.034],
        [0.02, 0.055],
        [-0.048, 0.055],
        [-0.066, 0.052],
    ]);
    let tower = [[-0.004, -0.0175], [0.056, -0.0175], [0.056, 0.0175], [-0.004, 0.0175]];
    let tower = extrude(&Profile::polygon(&tower), &[], [0.004, 0.028]);
    let walls = [-1.0, 1.0].map(|sign: f64| {
        let outline = Profile::polygon(&[[-0.02, 0.004], [0.055, 0.004], [0.052, 0.052], [-0.002, 0.056]]);
        let [a, b] = [sign * 0.0126, sign * 0.0175];
        side(&outline, [a.min(b), a.max(b)])
    });
    let back = block([-0.0095, -0.0175, 0.005], [-0.001, 0.0175, 0.058], 0.001);
    extrude(&plate, &[], [0.0, 0.0055]).with(&tower).with(&Mesh::of(&walls)).with(&back)
}

/// The driver board on its plate behind the tower.
pub(super) fn board() -> Mesh {
    let board = block([-0.054, -0.021, 0.009], [-0.014, 0.021, 0.0125], 0.0005);
    let terminals = block([-0.052, -0.012, 0.0125], [-0.04, 0.012, 0.022], 0.0008);
    let plug = block([-0.028, -0.016, 0.0125], [-0.016, 0.004, 0.019], 0.0008);
    Mesh::of(&[board, terminals, plug])
}

/// The turntable on the first servo, and the holder of the second.
pub(super) fn shoulder() -> Mesh {
    let table = cylinder(0.021, [0.0, 0.006], 0.001, 20);
    let floor = block([-0.012, -0.016, 0.005], [0.049, 0.0165, 0.0155], 0.002);
    let back = block([0.0005, -0.0145, 0.012], [0.0172, 0.0155, 0.056], 0.002);
    let front = block([0.0436, -0.0145, 0.012], [0.049, 0.0155, 0.045], 0.002);
    Mesh::of(&[table, floor, back, front])
}

/// The upper arm: a fork on the second servo, its web, and the box of the third.
pub(super) fn upper_arm() -> Mesh {
    let web = block([-0.013, -0.001, 0.043], [0.019, 0.038, 0.083], 0.003);
    let holder = block([-0.012, 0.0015, 0.08], [0.018, 0.036, 0.1275], 0.003);
    let ears = fork([0.004, 0.076], [0.0135, 0.0155], 0.0183);
    ears.with(&web).with(&holder)
}

/// The forearm: a fork on the third servo, its web, and the box of the fourth.
pub(super) fn lower_arm() -> Mesh {
    let web = block([0.046, -0.001, -0.014], [0.09, 0.038, 0.012], 0.003);
    let holder = block([0.086, 0.0015, -0.0105], [0.125, 0.036, 0.0205], 0.003);
    let ears = fork([0.083, 0.0], [0.0135, 0.0145], 0.0187);
    ears.with(&web).with(&holder)
}

/// The wrist: a fork on the fourth servo, and the box of the fifth across it.
pub(super) fn wrist() -> Mesh {
    let web = block([0.021, -0.004, -0.0125], [0.029, 0.0425, 0.0125], 0.002);
    let cheeks = [-1.0, 1.0].map(|sign: f64| {
        let [a, b] = [sign * 0.0125, sign * 0.0165];
        block([0.021, 0.004, a.min(b)], [0.05, 0.054, a.max(b)], 0.0015)
    });
    fork([0.022, 0.0], [0.0135, 0.0125], 0.0187).with(&web).with(&Mesh::of(&cheeks))
}

/// The body of the gripper round the sixth servo, and the finger that does not move.
pub(super) fn gripper() -> Mesh {
    let disc = cylinder(0.0165, [0.0, 0.006], 0.001, 18).along([1.0, 0.0, 0.0], [0.0; 3]);
    let rear = block([0.004, -0.0185, -0.02], [0.011, 0.0165, 0.026], 0.002);
    let floor = block([0.006, -0.0185, -0.023], [0.042, 0.0165, -0.0148], 0.002);
    let finger = Profile::polygon(&[
        [0.036, -0.0235],
        [0.062, -0.0265],
        [0.085, -0.0255],
        [0.101, -0.0195],
        [0.107, -0.0135],
        [0.107, -0.012],
        [0.078, -0.012],
        [0.058, -0.0145],
        [0.036, -0.0148],
    ]);
    let rib = block([0.03, -0.003, -0.0285], [0.082, 0.003, -0.0225], 0.001);
    let finger = side(&finger, [-0.0125, 0.0115]);
    Mesh::of(&[disc, rear, floor, finger, rib])
}

/// The jaw: cheeks on the sixth servo, and the finger that closes, its face 24.5 mm below the shaft.
pub(super) fn jaw() -> Mesh {
    let cheek = Profile::polygon(&[
        [0.0095, -0.0085],
        [0.004, -0.012],
        [-0.0055, -0.0105],
        [-0.0115, -0.003],
        [-0.0105, 0.006],
        [-0.003, 0.0115],
        [0.012, 0.01],
        [0.032, 0.0],
        [0.032, -0.01],
    ]);
    let cheeks = side(&cheek, [0.0, 0.004]).with(&side(&cheek, [-0.0414, -0.0374]));
    let bridge = block([0.018, -0.0414, -0.011], [0.034, 0.004, 0.004], 0.002);
    let finger = Profile::polygon(&[
        [0.026, -0.011],
        [0.044, -0.0195],
        [0.058, -0.0245],
        [0.0835, -0.0245],
        [0.0835, -0.0225],
        [0.074, -0.0135],
        [0.055, -0.004],
        [0.03, 0.004],
    ]);
    let knuckle = cylinder(0.006, [-0.004, 0.0055], 0.0, 10).along(Y, [0.0; 3]);
    cheeks.with(&bridge).with(&side(&finger, [-0.0312, -0.0072])).with(&knuckle)
}
