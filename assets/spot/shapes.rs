//! What the Spot-like quadruped looks like, each part in the frame of its body \[m\]: a long yellow shell in a black frame, hips that
//! stand out sideways, yellow thighs and thin black shins. Outlines are judged from photographs.

use workshop::{Mesh, Profile, Station, Vec3, cylinder, ellipsoid, extrude, loft, rounded_box, sweep};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A section of the body at `x`: half its width below and above, and its lower and upper edge.
struct Section {
    x: f64,
    half: [f64; 2],
    z: [f64; 2],
}

/// The body over sections from the tail to the nose; corners are cut by `cut`.
fn hull(sections: &[Section], cut: f64) -> Mesh {
    let ring = |Section { x, half: [below, above], z: [low, high] }: &Section| -> Vec<Vec3> {
        let half = [
            [below - cut, *low],
            [*below, low + cut],
            [below.max(*above), 0.55 * low + 0.45 * high],
            [*above, high - cut],
            [above - 1.6 * cut, *high],
        ];
        let left = half.iter().rev().map(|[y, z]| [*x, -y, *z]);
        half.iter().map(|[y, z]| [*x, *y, *z]).chain(left).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}

/// The same section at both ends of the body, nearer to the middle first.
fn both(sections: &[(f64, [f64; 2], [f64; 2])]) -> Vec<Section> {
    let section =
        |sign: f64, (x, half, z): &(f64, [f64; 2], [f64; 2])| Section { x: sign * x, half: *half, z: *z };
    let tail = sections.iter().rev().map(|row| section(-1.0, row));
    tail.chain(sections.iter().map(|row| section(1.0, row))).collect()
}

/// The yellow shell, from hip to hip and drawn in at both ends.
pub(super) fn shell() -> Mesh {
    let sections = both(&[
        (0.14, [0.093, 0.093], [-0.052, 0.086]),
        (0.245, [0.09, 0.092], [-0.05, 0.086]),
        (0.29, [0.07, 0.078], [-0.045, 0.083]),
        (0.385, [0.06, 0.068], [-0.035, 0.076]),
        (0.425, [0.05, 0.058], [-0.02, 0.062]),
    ]);
    hull(&sections, 0.014)
}

/// The black frame below the shell, its face and its tail.
pub(super) fn frame() -> Mesh {
    let keel = both(&[
        (0.2, [0.078, 0.084], [-0.082, -0.03]),
        (0.25, [0.07, 0.08], [-0.078, -0.03]),
        (0.4, [0.05, 0.056], [-0.06, -0.02]),
    ]);
    let face = rounded_box([0.012, 0.052, 0.043], 0.01, 1).moved([0.424, 0.0, 0.012]);
    let deck = rounded_box([0.17, 0.05, 0.006], 0.004, 1).moved([0.0, 0.0, 0.085]);
    Mesh::of(&[hull(&keel, 0.01), face.clone(), face.mirrored(0), deck])
}

/// The two rails on the back that carry payloads, and the panel between them.
pub(super) fn rails() -> Mesh {
    let rail = |y: f64| rounded_box([0.2, 0.006, 0.006], 0.002, 1).moved([0.0, y, 0.095]);
    let port = |x: f64| rounded_box([0.02, 0.018, 0.003], 0.001, 1).moved([x, 0.0, 0.092]);
    Mesh::of(&[rail(0.034), rail(-0.034), port(0.1), port(-0.06)])
}

/// Windows of the cameras: two in the face, one in either flank and one at the tail.
pub(super) fn eyes() -> Mesh {
    let round = |at: Vec3, out: Vec3| cylinder(0.014, [0.0, 0.004], 0.0, 10).along(out, at);
    let flank = |y: f64| rounded_box([0.035, 0.004, 0.013], 0.003, 1).moved([0.0, y, 0.02]);
    let face = [0.026, -0.026].map(|y| round([0.4345, y, 0.018], X));
    Mesh::of(&face)
        .with(&flank(0.092))
        .with(&flank(-0.092))
        .with(&round([-0.4345, 0.0, 0.018], [-1.0, 0.0, 0.0]))
}

/// The black case of the motor that swings a leg sideways, with the arm to the thigh.
pub(super) fn hip() -> Mesh {
    let along = cylinder(0.052, [-0.058, 0.058], 0.01, 10).along(X, [0.0; 3]);
    along.with(&cylinder(0.042, [0.02, 0.072], 0.0, 10).along(Y, [0.0; 3]))
}

/// The yellow drum of the motor at the top of the thigh, on the hip's side.
pub(super) fn drum() -> Mesh {
    cylinder(0.05, [0.058, 0.082], 0.008, 12).along(Y, [0.0; 3])
}

/// The thigh: broad over its motor, slender at the knee.
pub(super) fn thigh() -> Mesh {
    let path = [
        ([0.0, 0.0, 0.05], [0.02, 0.02]),
        ([0.0, 0.0, 0.034], [0.043, 0.031]),
        ([0.0, 0.0, 0.0], [0.053, 0.035]),
        ([0.01, 0.0, -0.17], [0.036, 0.026]),
        ([0.02, 0.0, -0.27], [0.03, 0.022]),
        ([0.024, 0.0, -0.335], [0.021, 0.018]),
    ];
    let stations: Vec<_> = path.iter().map(|(at, [x, y])| Station { at: *at, size: [*x, *y] }).collect();
    sweep(&Profile::superellipse([1.0, 1.0], 2.6, 12).turned(std::f64::consts::PI), &stations)
}

/// Black caps on the axes of the hip and the knee.
pub(super) fn caps() -> Mesh {
    let knee = cylinder(0.027, [-0.031, 0.031], 0.0, 10).along(Y, [0.025, 0.0, -0.32]);
    knee.with(&cylinder(0.03, [-0.039, 0.039], 0.0, 10).along(Y, [0.0; 3]))
}

/// The shin, a thin blade that bends back a little under the knee.
pub(super) fn shin() -> Mesh {
    let side = [
        [0.017, 0.014],
        [-0.017, 0.012],
        [-0.022, -0.03],
        [-0.018, -0.12],
        [-0.012, -0.315],
        [0.01, -0.315],
        [0.014, -0.12],
        [0.02, -0.04],
    ];
    let outline = Profile::polygon(&side.map(|[x, z]| [x, -z]));
    extrude(&outline, &[], [-0.012, 0.012]).mapped(|[x, z, y]| [x, y, -z])
}

/// The rubber foot.
pub(super) fn toe() -> Mesh {
    ellipsoid([0.036, 0.03, 0.036], 8).moved([0.0, 0.0, -0.337])
}
