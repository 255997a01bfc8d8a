//! What machines built of Dynamixel XM430 servos consist of, in outlines of the maker's drawings. Each part has the shaft's axis along
//! x, through the origin.

use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, rounded_box};

/// Half the width of a servo's case, along its shaft \[m\].
pub(crate) const HALF_WIDTH: f64 = 0.017;
const X: Vec3 = [1.0, 0.0, 0.0];

/// A part drawn in the plane of y and z, its height along x.
pub(crate) fn across(part: Mesh) -> Mesh {
    part.mapped(|[y, z, x]| [x, y, z])
}

/// The case of an XM430, 28.5 x 46.5 x 34 mm, below its shaft: two shells and the seam between them.
pub(crate) fn servo() -> Mesh {
    let ring = |inset: f64, x: f64| -> Vec<Vec3> {
        let outline = Profile::rounded_rectangle([0.01425 - inset, 0.02325 - inset], 0.004 - inset, 1);
        outline.points().iter().map(|[y, z]| [x, *y, z - 0.012]).collect()
    };
    let rings = [
        (0.0015, -HALF_WIDTH),
        (0.0, -HALF_WIDTH + 0.0015),
        (0.0, 0.0055),
        (0.0012, 0.007),
        (0.0, 0.0085),
        (0.0, HALF_WIDTH - 0.0015),
        (0.0015, HALF_WIDTH),
    ];
    loft(&rings.map(|(inset, x)| ring(inset, x)))
}

/// The horns on either end of a servo's shaft, with the ring of their screws.
pub(crate) fn horns() -> Mesh {
    cylinder(0.0105, [-HALF_WIDTH - 0.0015, HALF_WIDTH + 0.0015], 0.0, 12).along(X, [0.0; 3])
}

/// The bracket that a servo turns: two ears on its horns, and the bridge over them at `height` above the shaft, to which the next
/// link is screwed.
pub(crate) fn bracket(height: f64) -> Mesh {
    let ear = Profile::polygon(&[
        [-0.013, height],
        [-0.013, 0.012],
        [-0.0115, -0.001],
        [-0.0065, -0.0085],
        [0.0, -0.0105],
        [0.0065, -0.0085],
        [0.0115, -0.001],
        [0.013, 0.012],
        [0.013, height],
    ]);
    let ears =
        [-1.0, 1.0].map(|side: f64| across(extrude(&ear, &[], [side * 0.02 - 0.0015, side * 0.02 + 0.0015])));
    let bosses = [-1.0, 1.0].map(|side: f64| {
        cylinder(0.006, [0.0, 0.002], 0.0, 8).along([side, 0.0, 0.0], [side * 0.021, 0.0, 0.0])
    });
    let bridge = Profile::polygon(&[[-0.0215, -0.013], [0.0215, -0.013], [0.0215, 0.013], [-0.0215, 0.013]]);
    let bridge = extrude(&bridge, &[], [height - 0.0015, height + 0.0015]);
    Mesh::of(ears.iter().chain(&bosses)).with(&bridge)
}

/// The printed block between a bracket's bridge and the next servo.
pub(crate) fn clamp() -> Mesh {
    rounded_box([0.0175, 0.013, 0.005], 0.0015, 1).moved([0.0, 0.0, 0.0565])
}

/// A printed fingertip or foot on a bracket's bridge, which narrows to the rubber at its end.
pub(crate) fn tip() -> Mesh {
    let ring = |half: [f64; 2], height: f64| -> Vec<Vec3> {
        let outline = Profile::superellipse(half, 3.0, 12);
        outline.points().iter().map(|[x, y]| [*x, *y, height]).collect()
    };
    let rings = [
        ([0.024, 0.0135], 0.0545),
        ([0.024, 0.0135], 0.0595),
        ([0.0195, 0.013], 0.064),
        ([0.014, 0.0122], 0.075),
        ([0.0118, 0.0115], 0.088),
    ];
    loft(&rings.map(|(half, height)| ring(half, height)))
}

/// The rubber on a tip: a dome of 10.3 mm, 111 mm beyond the shaft.
pub(crate) fn rubber() -> Mesh {
    let line =
        [[0.0, 0.084], [0.0118, 0.086], [0.0108, 0.1], [0.0082, 0.1075], [0.0042, 0.1107], [0.0, 0.1113]];
    workshop::revolve(&line, 12)
}
