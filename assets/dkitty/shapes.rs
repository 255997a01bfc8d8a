//! What the body of the D'Kitty looks like, in the frame of its torso \[m\]: two plates that hold four servos between them, and a head.
//! Legs are made of the parts in `dynamixel.rs`.

use crate::dynamixel;
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, rounded_box};

const Y: Vec3 = [0.0, 1.0, 0.0];

/// The outline of a plate, broad where the servos are and narrow between them.
fn outline() -> Profile {
    let quarter: [[f64; 2]; 7] = [
        [0.046, 0.0],
        [0.047, 0.05],
        [0.056, 0.078],
        [0.07, 0.094],
        [0.087, 0.098],
        [0.0928, 0.104],
        [0.0928, 0.138],
    ];
    let right: Vec<_> = quarter.iter().skip(1).rev().map(|[x, y]| [*x, -y]).chain(quarter).collect();
    let left = right.iter().rev().map(|[x, y]| [-x, *y]);
    Profile::polygon(&right.iter().copied().chain(left).collect::<Vec<_>>())
}

/// One of the two plates, with openings that make it lighter.
pub(super) fn plate() -> Mesh {
    let opening = |half: [f64; 2], y: f64| Profile::rounded_rectangle(half, 0.008, 2).moved([0.0, y]);
    let openings =
        [opening([0.028, 0.024], 0.0), opening([0.03, 0.014], 0.062), opening([0.03, 0.014], -0.062)];
    extrude(&outline(), &openings, [-0.0012, 0.0012])
}

/// The frame between the plates, narrower than they are.
pub(super) fn spine() -> Mesh {
    let side = |sign: f64| rounded_box([0.004, 0.085, 0.0143], 0.001, 1).moved([sign * 0.038, 0.0, 0.0]);
    let across = |y: f64| rounded_box([0.05, 0.004, 0.0143], 0.001, 1).moved([0.0, y, 0.0]);
    Mesh::of(&[side(1.0), side(-1.0), across(0.084), across(-0.084), across(0.13), across(-0.13)])
}

/// The camera housing in front, which says where the robot looks.
pub(super) fn head() -> Mesh {
    rounded_box([0.034, 0.012, 0.016], 0.005, 1).moved([0.0, 0.148, 0.004])
}

/// The two lenses of the head.
pub(super) fn eyes() -> Mesh {
    let eye = |x: f64| cylinder(0.0085, [0.0, 0.0045], 0.001, 12).along(Y, [x, 0.158, 0.006]);
    eye(0.016).with(&eye(-0.016))
}

/// The hub that joins the cables, on the upper plate.
pub(super) fn board() -> Mesh {
    let hub = rounded_box([0.022, 0.032, 0.006], 0.002, 1).moved([0.0, 0.0, 0.0225]);
    let sockets = [-0.018, -0.006, 0.006, 0.018]
        .map(|y| rounded_box([0.005, 0.0045, 0.003], 0.0005, 1).moved([0.014, y, 0.03]));
    hub.with(&Mesh::of(&sockets))
}

/// The bracket of every joint of a leg.
pub(super) fn bracket() -> Mesh {
    dynamixel::bracket(0.0515)
}
