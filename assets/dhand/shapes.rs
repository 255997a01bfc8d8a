//! What the parts of the D'Hand look like \[m\]: those of `../dynamixel.rs` in fewer triangles, for a hand that has sixteen of each. Every
//! part has the axis of its shaft along x, through the origin.

use crate::dynamixel::{HALF_WIDTH, across};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, revolve};

/// Height of a bracket's bridge above the shaft \[m\].
const BRIDGE: f64 = 0.027;
const X: Vec3 = [1.0, 0.0, 0.0];

/// The plate that carries the fingers: three in a row, the thumb on the narrow side.
pub(super) fn plate() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.1, 0.022],
        [-0.092, 0.014],
        [-0.034, -0.066],
        [-0.022, -0.081],
        [0.022, -0.081],
        [0.034, -0.066],
        [0.092, 0.014],
        [0.1, 0.022],
        [0.1, 0.062],
        [0.092, 0.069],
        [-0.092, 0.069],
        [-0.1, 0.062],
    ]);
    let hole = Profile::circle(0.013, 10).moved([0.0, -0.008]);
    extrude(&outline, &[hole], [-0.003, 0.003])
}

/// The case of a servo below its shaft.
pub(super) fn servo() -> Mesh {
    let outline = Profile::rounded_rectangle([0.01425, 0.02325], 0.004, 1).moved([0.0, -0.012]);
    across(extrude(&outline, &[], [-HALF_WIDTH, HALF_WIDTH]))
}

/// The horns on either end of the shaft.
pub(super) fn horns() -> Mesh {
    cylinder(0.0105, [-HALF_WIDTH - 0.0015, HALF_WIDTH + 0.0015], 0.0, 8).along(X, [0.0; 3])
}

/// The bracket that a servo turns: two ears on its horns, the bridge over them, and the block below the next part.
pub(super) fn bracket() -> Mesh {
    let ear = Profile::polygon(&[
        [-0.013, BRIDGE],
        [-0.013, 0.012],
        [-0.0065, -0.0085],
        [0.0065, -0.0085],
        [0.013, 0.012],
        [0.013, BRIDGE],
    ]);
    let ears =
        [-1.0, 1.0].map(|side: f64| across(extrude(&ear, &[], [side * 0.02 - 0.0015, side * 0.02 + 0.0015])));
    let block = |half: [f64; 2], heights: [f64; 2]| {
        let [x, y] = half;
        extrude(&Profile::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]]), &[], heights)
    };
    let bridge = block([0.0215, 0.013], [BRIDGE - 0.0015, BRIDGE + 0.0015]);
    Mesh::of(&ears).with(&bridge).with(&block([0.0165, 0.0125], [BRIDGE, BRIDGE + 0.0065]))
}

/// A printed fingertip on a bracket's bridge, which narrows to the rubber at its end.
pub(super) fn tip() -> Mesh {
    let ring = |half: [f64; 2], height: f64| -> Vec<Vec3> {
        let outline = Profile::superellipse(half, 3.0, 8);
        outline.points().iter().map(|[x, y]| [*x, *y, height]).collect()
    };
    let rings = [
        ([0.024, 0.0135], BRIDGE),
        ([0.024, 0.0135], BRIDGE + 0.005),
        ([0.0165, 0.0125], BRIDGE + 0.015),
        ([0.0118, 0.0115], BRIDGE + 0.0335),
    ];
    loft(&rings.map(|(half, height)| ring(half, height)))
}

/// The rubber on a tip: a dome that ends where the capsule does.
pub(super) fn rubber() -> Mesh {
    let line = [[0.0, 0.057], [0.0118, 0.0585], [0.0112, 0.073], [0.0075, 0.081], [0.0, 0.084]];
    revolve(&line, 8)
}
