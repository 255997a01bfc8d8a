//! What the Darwin-OP-like humanoid looks like, each part in the frame of its body \[m\]: a round chest under a helmet with two large eyes, and
//! limbs of dark servos between grey covers. Outlines are judged from photographs; servos have the size of the maker's MX-28.

use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, rounded_box};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A shell about z over sections: height, middle along x, half sizes along x and y.
fn shell(sections: &[(f64, f64, [f64; 2])], exponent: f64, count: usize) -> Mesh {
    let ring = |(z, x, half): &(f64, f64, [f64; 2])| -> Vec<Vec3> {
        let outline = Profile::superellipse(*half, exponent, count);
        outline.points().iter().map(|[a, b]| [x + a, *b, *z]).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}

/// The chest, which bulges forward, down to the waist.
pub(super) fn chest() -> Mesh {
    let sections = [
        (-0.088, -0.006, [0.026, 0.034]),
        (-0.08, -0.004, [0.034, 0.042]),
        (-0.055, 0.0, [0.044, 0.05]),
        (-0.025, 0.002, [0.05, 0.055]),
        (0.002, -0.002, [0.045, 0.054]),
        (0.02, -0.006, [0.032, 0.044]),
        (0.026, -0.008, [0.02, 0.03]),
    ];
    shell(&sections, 2.6, 14)
}

/// The dark backpack with battery and computer, the waist and the seats of the shoulders.
pub(super) fn trunk() -> Mesh {
    let pack = rounded_box([0.02, 0.042, 0.046], 0.008, 1).moved([-0.052, 0.0, -0.036]);
    let waist = rounded_box([0.03, 0.056, 0.01], 0.004, 1).moved([-0.005, 0.0, -0.092]);
    let seat = |y: f64| cylinder(0.017, [-0.006, 0.006], 0.0, 10).along(Y, [0.0, y, 0.0]);
    Mesh::of(&[pack, waist, seat(0.055), seat(-0.055)])
}

/// The lit ring on the chest.
pub(super) fn badge() -> Mesh {
    let outline = Profile::circle(0.017, 14);
    let ring = extrude(&outline, &[outline.inset(0.005)], [0.0, 0.006]);
    ring.mapped(|[y, z, x]| [x, y, z]).moved([0.0475, 0.0, -0.022])
}

/// The helmet, with round ears.
pub(super) fn helmet() -> Mesh {
    let sections = [
        (-0.012, -0.002, [0.022, 0.026]),
        (-0.006, 0.0, [0.034, 0.038]),
        (0.012, 0.002, [0.041, 0.046]),
        (0.034, 0.002, [0.042, 0.047]),
        (0.05, -0.002, [0.035, 0.04]),
        (0.059, -0.006, [0.022, 0.027]),
        (0.062, -0.008, [0.01, 0.013]),
    ];
    let ear = |y: f64| cylinder(0.02, [-0.007, 0.007], 0.0, 10).along(Y, [-0.004, y, 0.022]);
    Mesh::of(&[shell(&sections, 2.4, 14), ear(0.047), ear(-0.047)])
}

/// The dark face, and pupils in the eyes.
pub(super) fn visor() -> Mesh {
    let face = rounded_box([0.014, 0.037, 0.017], 0.008, 1).moved([0.034, 0.0, 0.022]);
    let pupil = |y: f64| cylinder(0.0075, [0.0, 0.005], 0.0, 8).along(X, [0.048, y, 0.024]);
    Mesh::of(&[face, pupil(0.018), pupil(-0.018)])
}

/// The lit rings of the eyes, and the lamp on the forehead.
pub(super) fn eyes() -> Mesh {
    let eye = |y: f64| cylinder(0.0135, [0.0, 0.003], 0.0, 12).along(X, [0.0475, y, 0.024]);
    let lamp = cylinder(0.005, [0.0, 0.004], 0.0, 8).along(X, [0.0335, 0.0, 0.049]);
    Mesh::of(&[eye(0.018), eye(-0.018), lamp])
}

/// The case of a servo, its shaft along x near the upper end.
pub(super) fn servo() -> Mesh {
    let case = rounded_box([0.0178, 0.0178, 0.0253], 0.003, 1).moved([0.0, 0.0, -0.006]);
    case.with(&cylinder(0.011, [-0.0205, 0.0205], 0.0, 6).along(X, [0.0; 3]))
}

/// A bracket between two axes.
pub(super) fn yoke() -> Mesh {
    rounded_box([0.015, 0.015, 0.013], 0.003, 1)
}

/// The cap over a shoulder.
pub(super) fn pauldron() -> Mesh {
    shell(
        &[(-0.014, 0.0, [0.0215, 0.0215]), (0.006, 0.0, [0.0215, 0.021]), (0.017, 0.0, [0.013, 0.013])],
        3.0,
        10,
    )
}

/// The cover of a forearm.
pub(super) fn forearm() -> Mesh {
    let sections = [
        (-0.1, 0.0, [0.011, 0.011]),
        (-0.092, 0.0, [0.015, 0.015]),
        (-0.02, 0.0, [0.018, 0.018]),
        (0.012, 0.0, [0.016, 0.017]),
        (0.017, 0.0, [0.01, 0.011]),
    ];
    shell(&sections, 3.0, 10)
}

/// The hand, a plain claw.
pub(super) fn hand() -> Mesh {
    let side = Profile::polygon(&[[0.004, 0.01], [-0.004, 0.01], [-0.004, -0.01], [0.004, -0.01]]);
    let half = |x: f64| extrude(&side.moved([x, 0.0]), &[], [-0.129, -0.095]);
    half(0.006).with(&half(-0.006))
}

/// The cover on the front of a thigh.
pub(super) fn thigh() -> Mesh {
    let sections = [
        (-0.064, 0.006, [0.013, 0.015]),
        (-0.056, 0.008, [0.018, 0.02]),
        (-0.03, 0.008, [0.02, 0.0215]),
        (-0.008, 0.006, [0.014, 0.017]),
    ];
    shell(&sections, 3.0, 10)
}

/// The cover on the front of a shin.
pub(super) fn shin() -> Mesh {
    let sections = [
        (-0.076, 0.002, [0.013, 0.015]),
        (-0.06, 0.006, [0.018, 0.018]),
        (-0.035, 0.008, [0.021, 0.02]),
        (-0.012, 0.006, [0.014, 0.016]),
    ];
    shell(&sections, 3.0, 10)
}

/// The two metal straps along a thigh or a shin, round at the axes that they join.
pub(super) fn straps() -> Mesh {
    let strap = |y: f64| extrude(&Profile::link([0.013, 0.013], 0.093, 2), &[], [y - 0.0015, y + 0.0015]);
    strap(0.0225).with(&strap(-0.0225)).mapped(|[down, x, y]| [-x, y, -down])
}

/// The cover of a foot.
pub(super) fn foot() -> Mesh {
    let sections =
        [(-0.026, 0.0, [0.05, 0.031]), (-0.02, 0.0, [0.048, 0.03]), (-0.012, -0.004, [0.03, 0.024])];
    shell(&sections, 5.0, 12)
}

/// The sole.
pub(super) fn sole() -> Mesh {
    rounded_box([0.052, 0.033, 0.004], 0.003, 1).moved([0.0, 0.0, -0.0295])
}
