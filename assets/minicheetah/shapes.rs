//! What the Mini-Cheetah-like quadruped looks like, each part in the frame of its body \[m\]: a small box between twelve flat round motors,
//! two of which are stacked at each corner, and legs of flat bars. Outlines are judged from photographs.

use workshop::{Mesh, Profile, Vec3, cylinder, ellipsoid, extrude, rounded_box};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// The dark box of the trunk, with the battery's cover on it.
pub(super) fn trunk() -> Mesh {
    let hull = rounded_box([0.128, 0.062, 0.042], 0.008, 1);
    let cover = rounded_box([0.09, 0.05, 0.012], 0.008, 1).moved([0.0, 0.0, 0.046]);
    let face = |x: f64| rounded_box([0.012, 0.026, 0.026], 0.006, 1).moved([x, 0.0, 0.004]);
    Mesh::of(&[hull, cover, face(0.135), face(-0.135)])
}

/// Bright parts of the trunk: plates on its flanks, and the four motors at its ends that swing legs sideways.
pub(super) fn plates() -> Mesh {
    let outline = Profile::rounded_rectangle([0.1, 0.034], 0.012, 2);
    let slot = |x: f64| Profile::rounded_rectangle([0.02, 0.02], 0.006, 1).moved([x, 0.0]);
    let plate = extrude(&outline, &[slot(0.06), slot(0.0), slot(-0.06)], [0.0, 0.003]);
    let plate = plate.mapped(|[x, z, y]| [x, -y - 0.062, z]);
    let motor =
        |x: f64, y: f64| cylinder(0.046, [-0.014, 0.014], 0.005, 12).along([x, 0.0, 0.0], [x, y, 0.0]);
    let motors =
        [(0.126, 0.049), (0.126, -0.049), (-0.126, 0.049), (-0.126, -0.049)].map(|(x, y)| motor(x, y));
    Mesh::of(&motors).with(&plate).with(&plate.clone().mirrored(1))
}

/// Red stripes along the cover.
pub(super) fn trim() -> Mesh {
    let stripe = |y: f64| rounded_box([0.07, 0.004, 0.002], 0.001, 1).moved([0.0, y, 0.058]);
    stripe(0.032).with(&stripe(-0.032))
}

/// A motor of the hip or the knee, its axis along y.
pub(super) fn motor() -> Mesh {
    cylinder(0.047, [-0.0105, 0.0105], 0.004, 12).along(Y, [0.0; 3])
}

/// What the sideways motor turns: its flange.
pub(super) fn flange() -> Mesh {
    cylinder(0.036, [-0.008, 0.008], 0.0, 12).along(X, [0.0; 3])
}

/// The dark bracket that holds the hip's motor, here of a left leg.
pub(super) fn yoke() -> Mesh {
    rounded_box([0.036, 0.008, 0.03], 0.006, 1).moved([0.0, 0.01, 0.0])
}

/// The thigh of a left leg: a bar from the hip to the knee, outside of the motors.
pub(super) fn thigh() -> Mesh {
    let bar = Profile::link([0.036, 0.021], 0.209, 6);
    extrude(&bar, &[], [0.007, 0.019]).mapped(|[down, x, y]| [-x, y, -down])
}

/// Bright discs on the axes of a left leg's hip and knee.
pub(super) fn caps() -> Mesh {
    let hip = cylinder(0.024, [0.016, 0.022], 0.0, 10).along(Y, [0.0; 3]);
    hip.with(&cylinder(0.0145, [-0.006, 0.021], 0.0, 10).along(Y, [0.0, 0.0, -0.209]))
}

/// The shin, a slender bar that narrows to the foot.
pub(super) fn shin() -> Mesh {
    let bar = extrude(&Profile::link([0.014, 0.007], 0.188, 4), &[], [-0.008, 0.0025]);
    bar.mapped(|[down, x, y]| [-x, y, -down])
}

/// The rubber foot.
pub(super) fn toe() -> Mesh {
    ellipsoid([0.0175, 0.0145, 0.0175], 8).moved([0.0, 0.0, -0.195])
}
