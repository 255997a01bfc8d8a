//! What the links of the Shadow hand look like, each in the frame of its body \[m\]: fingers point along z, the palm faces -y. Shells are
//! black and square, joints are metal drums, fingertips have pale pads. Widths keep to what collides.

use crate::fingers::{bar, plate, tip};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, revolve, rounded_box};

/// Steps round a joint of a finger.
const ROUND: usize = 8;
const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// A drum about an axis through `centre`, `half` to either side.
fn drum(radius: f64, axis: Vec3, centre: Vec3, half: f64) -> Mesh {
    cylinder(radius, [-half, half], 0.0, ROUND).along(axis, centre)
}

/// The shell of the forearm: broad round the motors, with flat sides, and narrow at the wrist.
pub(super) fn forearm() -> Mesh {
    let ring = |(z, half, off, exponent): &(f64, [f64; 2], f64, f64)| -> Vec<Vec3> {
        let outline = Profile::superellipse(*half, *exponent, 16);
        outline.points().iter().map(|[x, y]| [*x, *y + off, *z]).collect()
    };
    let rings = [
        (0.018, [0.068, 0.068], 0.0, 3.0),
        (0.024, [0.0735, 0.0735], 0.0, 3.0),
        (0.118, [0.0735, 0.0735], 0.0, 3.0),
        (0.128, [0.07, 0.07], 0.0, 3.0),
        (0.158, [0.052, 0.047], -0.004, 2.8),
        (0.178, [0.037, 0.034], -0.008, 2.6),
        (0.192, [0.031, 0.027], -0.01, 2.6),
    ];
    let cheek =
        Profile::link([0.012, 0.014], 0.026, 4).turned(-std::f64::consts::FRAC_PI_2).moved([0.0, 0.213]);
    let ears = [[-0.0295, -0.0248], [0.0048, 0.0095]].map(|heights| plate(&cheek, heights, 0.0008));
    loft(&rings.each_ref().map(ring)).with(&Mesh::of(&ears))
}

/// The base of the forearm, a band round its shell, and lids over the motors.
pub(super) fn forearm_metal() -> Mesh {
    let base = [[0.064, 0.0], [0.07, 0.004], [0.07, 0.018], [0.064, 0.02]];
    let lid = extrude(&Profile::rounded_rectangle([0.034, 0.034], 0.004, 1), &[], [0.07, 0.0765]);
    let lid = lid.along(Y, [0.0, 0.0, 0.071]);
    let lids = [0.0, 0.25, 0.5, 0.75].map(|turn| lid.clone().turned(Z, std::f64::consts::TAU * turn));
    revolve(&base, 12).with(&Mesh::of(&lids)).with(&drum(0.007, Y, [0.0, -0.01, 0.213], 0.0212))
}

/// The block between the two axes of the wrist.
pub(super) fn wrist() -> Mesh {
    let block = bar(
        &[
            (0.0, [0.012, 0.0135], 0.0),
            (0.014, [0.0165, 0.0128], 0.0),
            (0.026, [0.0165, 0.0108], 0.0),
            (0.036, [0.0165, 0.0085], 0.0),
        ],
        0.003,
        1,
    );
    Mesh::of([&drum(0.0125, Y, [0.0; 3], 0.0145), &block, &drum(0.0102, X, [0.0, 0.0, 0.034], 0.0225)])
}

/// The shell of the palm, without the little finger's metacarpal.
pub(super) fn palm() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.019, -0.008],
        [0.019, -0.008],
        [0.024, -0.003],
        [0.0425, 0.004],
        [0.0435, 0.078],
        [0.04, 0.085],
        [0.025, 0.086],
        [0.02, 0.09],
        [0.002, 0.09],
        [-0.003, 0.086],
        [-0.0195, 0.085],
        [-0.021, 0.08],
        [-0.021, 0.034],
        [-0.0405, 0.028],
        [-0.041, -0.004],
        [-0.024, -0.008],
    ]);
    plate(&outline, [-0.0105, 0.0118], 0.0022)
}

/// The ears that hold the knuckles, the plate on the back of the hand, and the caps of the wrist's axis.
pub(super) fn palm_metal() -> Mesh {
    let ear = |[x, z]: [f64; 2]| drum(0.0072, Y, [x, 0.0, z], 0.0098);
    let back = Profile::polygon(&[
        [-0.016, 0.014],
        [0.034, 0.014],
        [0.0375, 0.02],
        [0.0375, 0.066],
        [0.03, 0.072],
        [-0.016, 0.072],
    ]);
    let ears = [ear([0.033, 0.095]), ear([0.011, 0.099]), ear([-0.011, 0.095])];
    Mesh::of(&ears).with(&plate(&back, [0.01, 0.0138], 0.0014)).with(&drum(0.0072, X, [0.0; 3], 0.0265))
}

/// Pads below the fingers and at the heel of the hand.
pub(super) fn palm_pads() -> Mesh {
    let cushion = |half: [f64; 2], [x, z]: [f64; 2]| {
        rounded_box([half[0], 0.003, half[1]], 0.0022, 1).moved([x, -0.0102, z])
    };
    Mesh::of(&[cushion([0.0295, 0.0125], [0.011, 0.068]), cushion([0.0185, 0.0145], [0.0, 0.032])])
}

/// The bone of the little finger within the palm.
pub(super) fn metacarpal() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.0085, 0.009],
        [0.011, 0.009],
        [0.0112, 0.05],
        [0.0065, 0.0555],
        [-0.0065, 0.0555],
        [-0.0088, 0.05],
    ]);
    plate(&outline, [-0.0105, 0.0115], 0.0022)
}

pub(super) fn metacarpal_pad() -> Mesh {
    rounded_box([0.0085, 0.003, 0.017], 0.0022, 1).moved([0.001, -0.0102, 0.032])
}

/// The cross of a knuckle: about y in the ears, about x in the finger.
pub(super) fn knuckle() -> Mesh {
    drum(0.006, Y, [0.0; 3], 0.0072).with(&drum(0.0088, X, [0.0; 3], 0.0082))
}

/// A link of a finger: its shell, which is full towards the palm, and the drum of the joint behind it.
fn phalanx(length: f64, half: [f64; 2]) -> Mesh {
    let [wide, deep] = half;
    let shell = bar(
        &[
            (0.0035, [0.72 * wide, 0.7 * deep], 0.0),
            (0.0095, [wide, deep], -0.0006),
            (length - 0.01, [0.96 * wide, 0.92 * deep], -0.0006),
            (length - 0.0035, [0.7 * wide, 0.66 * deep], 0.0),
        ],
        0.0034,
        1,
    );
    shell.with(&drum(0.0074, X, [0.0, 0.0, length], 0.0078))
}

pub(super) fn proximal() -> Mesh {
    phalanx(0.045, [0.009, 0.0092])
}

pub(super) fn middle() -> Mesh {
    phalanx(0.025, [0.0084, 0.0086])
}

/// The shell on the back of a fingertip.
fn nail(length: f64, [wide, deep]: [f64; 2]) -> Mesh {
    let off = 0.35 * deep;
    bar(
        &[
            (0.0035, [0.75 * wide, 0.6 * deep], 0.0),
            (0.0095, [1.06 * wide, 0.78 * deep], off),
            (0.6 * length, [1.04 * wide, 0.74 * deep], off),
            (0.86 * length, [0.72 * wide, 0.42 * deep], 1.1 * off),
        ],
        0.0025,
        1,
    )
}

pub(super) fn distal() -> Mesh {
    nail(0.031, [0.0074, 0.0075])
}

pub(super) fn distal_pad() -> Mesh {
    tip(0.0313, [0.0078, 0.0079], 6)
}

/// The thumb's lower link, from the ball in the palm to the hub.
pub(super) fn thumb_proximal() -> Mesh {
    let shell = bar(
        &[
            (0.002, [0.0085, 0.0085], 0.0),
            (0.011, [0.0115, 0.0112], 0.0),
            (0.026, [0.011, 0.0105], 0.0),
            (0.033, [0.0085, 0.0078], 0.0),
        ],
        0.004,
        1,
    );
    shell.with(&drum(0.0122, X, [0.0; 3], 0.0112))
}

/// The cross in the middle of the thumb.
pub(super) fn thumb_hub() -> Mesh {
    drum(0.0082, X, [0.0; 3], 0.0112).with(&drum(0.0068, Y, [0.0; 3], 0.0105))
}

pub(super) fn thumb_middle() -> Mesh {
    let shell = bar(
        &[
            (0.004, [0.0075, 0.0078], 0.0),
            (0.0095, [0.0098, 0.0102], 0.0),
            (0.022, [0.0092, 0.0098], 0.0),
            (0.028, [0.007, 0.0075], 0.0),
        ],
        0.0036,
        1,
    );
    shell.with(&drum(0.0086, Y, [0.0, 0.0, 0.032], 0.0098))
}

pub(super) fn thumb_distal() -> Mesh {
    nail(0.0352, [0.0094, 0.0094])
}

pub(super) fn thumb_distal_pad() -> Mesh {
    tip(0.0354, [0.0098, 0.0098], 6)
}
