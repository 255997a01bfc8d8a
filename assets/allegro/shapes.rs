//! What the links of the Allegro hand look like, each in the frame of its body \[m\]: fingers point along z and bend about y, the palm
//! faces x. Cases of the motors are dark and square, as wide as the boxes that collide; fingertips are white rubber.

use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, revolve, rounded_box};

/// Half the width of a finger, along the axes of its joints \[m\].
const WIDE: f64 = 0.0138;
/// Half its depth \[m\].
const DEEP: f64 = 0.0098;
const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A disc about the y axis, `half` to either side.
fn disc(radius: f64, half: f64, count: usize) -> Mesh {
    cylinder(radius, [-half, half], 0.0, count).along(Y, [0.0; 3])
}

/// A part drawn in x and z, between two widths along y.
fn across(outline: &Profile, widths: [f64; 2]) -> Mesh {
    extrude(outline, &[], widths).mapped(|[x, z, y]| [x, -y, z])
}

/// The same part on either side.
fn both(part: &Mesh) -> Mesh {
    part.clone().with(&part.clone().mirrored(1))
}

/// A motor's case between two heights, its rims cut.
fn case([low, high]: [f64; 2], half: [f64; 2]) -> Mesh {
    let ring = |inset: f64, z: f64| -> Vec<Vec3> {
        let outline = Profile::rounded_rectangle([half[0] - inset, half[1] - inset], 0.0022, 1);
        outline.points().iter().map(|[x, y]| [*x, *y, z]).collect()
    };
    loft(&[ring(0.0012, low), ring(0.0, low + 0.0012), ring(0.0, high - 0.0012), ring(0.0012, high)])
}

/// A link that turns about the origin and carries the next joint `length` above: a case, and cheeks that reach down to the horns.
fn link(length: f64) -> Mesh {
    let cheek = Profile::link([0.0088, 0.0094], 0.62 * length, 3).turned(std::f64::consts::FRAC_PI_2);
    let cheek = both(&across(&cheek, [WIDE - 0.0022, WIDE]));
    case([0.0102, length + 0.0072], [DEEP, WIDE - 0.0024]).with(&cheek)
}

/// The motor in the knuckle that turns a finger about its long axis.
pub(super) fn base() -> Mesh {
    case([-0.001, 0.0232], [DEEP, WIDE - 0.0024])
}

/// The collar on the palm in which the knuckle turns.
pub(super) fn base_horns() -> Mesh {
    cylinder(0.0092, [-0.003, -0.0008], 0.0, 8)
}

pub(super) fn proximal() -> Mesh {
    link(0.054)
}

pub(super) fn medial() -> Mesh {
    link(0.0384)
}

pub(super) fn distal() -> Mesh {
    let cheek = Profile::link([0.0088, 0.0094], 0.009, 3).turned(std::f64::consts::FRAC_PI_2);
    let cheek = both(&across(&cheek, [WIDE - 0.0022, WIDE]));
    case([0.0095, 0.018], [DEEP, WIDE - 0.0012]).with(&cheek)
}

/// The horns of a joint's motor, and the screw in the middle of each.
pub(super) fn link_horns() -> Mesh {
    disc(0.0058, WIDE + 0.0008, 8).with(&disc(0.0022, WIDE + 0.0016, 5))
}

/// A dome of rubber from a height to 12 mm above the capsule's end at `end`.
fn dome(start: f64, end: f64) -> Mesh {
    let line = [
        [0.0, start],
        [0.012, start + 0.002],
        [0.012, end],
        [0.0102, end + 0.0064],
        [0.0058, end + 0.0105],
        [0.0, end + 0.012],
    ];
    revolve(&line, 10)
}

pub(super) fn tip() -> Mesh {
    dome(0.0175, 0.029)
}

pub(super) fn thumb_tip() -> Mesh {
    dome(0.0315, 0.043)
}

/// The block with the two motors at the thumb's root.
pub(super) fn thumb_base() -> Mesh {
    let block = rounded_box([0.0172, 0.0162, 0.0195], 0.0025, 1).moved([-0.018, 0.009, 0.0125]);
    let collar = cylinder(0.0098, [0.0, 0.0095], 0.0, 12).moved([-0.027, 0.005, 0.0305]);
    let shaft = cylinder(0.0125, [-0.001, 0.003], 0.0, 12).along(X, [0.0; 3]);
    Mesh::of([&block, &collar, &shaft])
}

pub(super) fn thumb_medial() -> Mesh {
    link(0.0514)
}

pub(super) fn thumb_distal() -> Mesh {
    let cheek = Profile::link([0.0088, 0.0094], 0.019, 3).turned(std::f64::consts::FRAC_PI_2);
    let cheek = both(&across(&cheek, [WIDE - 0.0022, WIDE]));
    case([0.0102, 0.032], [DEEP, WIDE - 0.0024]).with(&cheek)
}

/// The palm's frame: a box whose rims are cut, and the plate of its mount below.
pub(super) fn palm() -> Mesh {
    let outline = |inset: f64| {
        Profile::polygon(&[
            [-0.0565 + inset, -0.0045 - inset],
            [-0.0565 + inset, -0.075],
            [-0.036, -0.0955 + inset],
            [0.036, -0.0955 + inset],
            [0.0565 - inset, -0.075],
            [0.0565 - inset, -0.0045 - inset],
            [0.024, -0.0045 - inset],
            [0.019, -0.0025 - inset],
            [-0.019, -0.0025 - inset],
            [-0.024, -0.0045 - inset],
        ])
    };
    let ring = |inset: f64, x: f64| -> Vec<Vec3> {
        outline(inset).points().iter().map(|[y, z]| [x, *y, *z]).collect()
    };
    let frame = loft(&[ring(0.003, -0.0297), ring(0.0, -0.0267), ring(0.0, 0.0071), ring(0.003, 0.0101)]);
    let mount = cylinder(0.02, [-0.1015, -0.094], 0.0, 12).moved([-0.0098, 0.0, 0.0]);
    frame.with(&mount)
}

/// A plate in y and z before the palm or behind it.
fn plate(points: &[[f64; 2]], depths: [f64; 2]) -> Mesh {
    extrude(&Profile::polygon(points), &[], depths).mapped(|[y, z, x]| [x, y, z])
}

/// The cover of the palm, which leaves room for the thumb, and that of the back.
pub(super) fn palm_plates() -> Mesh {
    let front = [
        [-0.05, -0.012],
        [0.05, -0.012],
        [0.05, -0.03],
        [0.004, -0.034],
        [0.0, -0.04],
        [0.0, -0.088],
        [-0.033, -0.088],
        [-0.05, -0.071],
    ];
    let back = [
        [-0.048, -0.014],
        [0.048, -0.014],
        [0.048, -0.07],
        [0.032, -0.086],
        [-0.032, -0.086],
        [-0.048, -0.07],
    ];
    plate(&front, [0.0095, 0.0111]).with(&plate(&back, [-0.0315, -0.029]))
}

/// Screws in the corners of both covers.
pub(super) fn palm_screws() -> Mesh {
    let screw = |x: f64, side: f64, [y, z]: [f64; 2]| {
        cylinder(0.0024, [0.0, 0.0008], 0.0, 5).along([side, 0.0, 0.0], [x, y, z])
    };
    let front = [[-0.045, -0.017], [0.045, -0.017], [-0.045, -0.068]].map(|at| screw(0.0109, 1.0, at));
    let back = [[-0.043, -0.019], [0.043, -0.019], [-0.03, -0.081], [0.03, -0.081]]
        .map(|at| screw(-0.0313, -1.0, at));
    Mesh::of(front.iter().chain(&back))
}
