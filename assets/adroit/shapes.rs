//! What the links of the Adroit hand look like, each in the frame of its body \[m\]. Fingers point along z, the palm faces -y, the
//! thumb's pads face -x. Plates and links are metal, joints dark, pads of a soft plastic. Lengths between joints are the model's;
//! widths keep to the capsules that collide.

use crate::fingers::{bar, plate, tip};
use workshop::{Mesh, Profile, Station, Vec3, cylinder, extrude, revolve, rounded_box, sweep};

/// Steps round a joint of a finger.
const ROUND: usize = 12;
const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A drum about an axis through `centre`, `half` to either side.
fn drum(radius: f64, axis: Vec3, centre: Vec3, half: f64) -> Mesh {
    cylinder(radius, [-half, half], 0.0008, ROUND).along(axis, centre)
}

/// Two cheeks that hold a joint about x at the height `z`, each reaching `down` along the link.
fn fork(radius: f64, z: f64, down: f64, [inner, outer]: [f64; 2]) -> Mesh {
    let side = Profile::link([radius, radius * 0.92], down, 5);
    // Drawn along x, and stood up against z.
    let cheek = extrude(&side, &[], [inner, outer]).mapped(|[along, across, x]| [x, across, z - along]);
    let other = extrude(&side, &[], [-outer, -inner]).mapped(|[along, across, x]| [x, across, z - along]);
    cheek.with(&other)
}

/// A link of a finger: the tongue in the joint before it, the bar, and the fork of the joint behind it.
fn phalanx(length: f64, [near, far]: [f64; 2]) -> Mesh {
    let tongue = drum(near, X, [0.0; 3], 0.0058);
    let bones = bar(
        &[
            (0.5 * near, [0.0055, 0.6 * near], 0.001),
            (near, [0.0085, 0.72 * near], 0.001),
            (length - 1.5 * far, [0.0082, 0.72 * far], 0.001),
            (length - far, [0.0062, 0.6 * far], 0.001),
        ],
        0.003,
        2,
    );
    let cheeks = fork(far, length, 1.9 * far, [0.0062, 0.0088]);
    Mesh::of([&tongue, &bones, &cheeks])
}

/// A soft pad before a link, from one height to another: half its width, and how far it stands out to -y.
fn pad([low, high]: [f64; 2], half: f64, depth: f64) -> Mesh {
    let middle = 0.5 * (low + high);
    let length = 0.5 * (high - low);
    rounded_box([half, 0.55 * depth, length], 0.003, 2).moved([0.0, -0.45 * depth, middle])
}

/// The shell of the actuators: a bottle, whose neck ends in the cheeks that hold the wrist.
pub(super) fn forearm() -> Mesh {
    let round = Profile::circle(1.0, 28);
    let path = [
        (0.208, [0.055, 0.055]),
        (0.212, [0.0585, 0.0585]),
        (0.275, [0.0594, 0.0594]),
        (0.306, [0.056, 0.0575]),
        (0.332, [0.043, 0.049]),
        (0.352, [0.03, 0.036]),
        (0.368, [0.023, 0.0255]),
        (0.376, [0.02, 0.0225]),
    ];
    let stations: Vec<_> = path.iter().map(|(z, size)| Station { at: [0.0, 0.0, *z], size: *size }).collect();
    let side = Profile::link([0.0125, 0.014], 0.028, 6);
    let cheek = extrude(&side, &[], [0.0152, 0.0205]).mapped(|[along, x, y]| [x, y, 0.396 - along]);
    // Seen along y, the outline of this cheek runs the other way.
    let cheek = cheek.mirrored(0).mapped(|[x, y, z]| [-x, y, z]);
    let cheek = oriented(cheek);
    let other = cheek.clone().mirrored(1);
    Mesh::of([&sweep(&round, &stations), &cheek, &other])
}

/// The mesh with its faces outward.
fn oriented(mesh: Mesh) -> Mesh {
    if mesh.volume() < 0.0 { mesh.mirrored(0).mapped(|[x, y, z]| [-x, y, z]) } else { mesh }
}

/// The flange below the shell, a band round it, and caps on the wrist's axis.
pub(super) fn forearm_dark() -> Mesh {
    let flange =
        [[0.039, 0.17], [0.04, 0.18], [0.034, 0.183], [0.034, 0.194], [0.057, 0.203], [0.057, 0.211]];
    let band = [[0.0585, 0.281], [0.0608, 0.283], [0.0606, 0.289], [0.0585, 0.292], [0.0585, 0.281]];
    let caps = drum(0.0085, Y, [0.0, 0.0, 0.396], 0.0215);
    Mesh::of([&revolve(&flange, 24), &revolve(&band, 28), &caps])
}

/// The cross between the two axes of the wrist: a drum about y, and a yoke up to the axis along x.
pub(super) fn wrist() -> Mesh {
    let path = [
        ([-0.0275, 0.0, 0.036], [0.0045, 0.0095]),
        ([-0.0275, 0.0, 0.024], [0.0045, 0.0105]),
        ([-0.024, 0.0, 0.012], [0.0055, 0.0125]),
        ([-0.013, 0.0, 0.002], [0.007, 0.014]),
        ([0.0, 0.0, -0.001], [0.0075, 0.0145]),
        ([0.013, 0.0, 0.002], [0.007, 0.014]),
        ([0.024, 0.0, 0.012], [0.0055, 0.0125]),
        ([0.0275, 0.0, 0.024], [0.0045, 0.0105]),
        ([0.0275, 0.0, 0.036], [0.0045, 0.0095]),
    ];
    // The first section's axes are those of the frame nearest to the path: x across stays in the plane of the yoke.
    let stations: Vec<_> = path.iter().map(|(at, size)| Station { at: *at, size: *size }).collect();
    let yoke = sweep(&Profile::superellipse([1.0, 1.0], 3.0, ROUND), &stations);
    let left = drum(0.0102, X, [-0.0275, 0.0, 0.034], 0.005);
    let right = drum(0.0102, X, [0.0275, 0.0, 0.034], 0.005);
    Mesh::of([&drum(0.0132, Y, [0.0; 3], 0.0148), &yoke, &left, &right])
}

/// The outline of the palm in x and z, without the little finger's metacarpal.
fn palm_outline() -> Profile {
    Profile::polygon(&[
        [-0.019, -0.009],
        [0.019, -0.009],
        [0.0215, 0.002],
        [0.034, 0.006],
        [0.0435, 0.018],
        [0.0435, 0.08],
        [0.041, 0.086],
        [0.024, 0.086],
        [0.021, 0.09],
        [0.002, 0.09],
        [-0.001, 0.086],
        [-0.0195, 0.086],
        [-0.0215, 0.083],
        [-0.0225, 0.042],
        [-0.026, 0.037],
        [-0.041, 0.034],
        [-0.0435, 0.03],
        [-0.0435, 0.012],
        [-0.037, 0.004],
        [-0.0215, 0.002],
    ])
}

/// Ears that hold a knuckle about y at a place of x and z.
fn ears(x: f64, z: f64) -> Mesh {
    let outline =
        Profile::link([0.0065, 0.0085], 0.014, 4).turned(-std::f64::consts::FRAC_PI_2).moved([x, z]);
    plate(&outline, [0.0068, 0.0105], 0.0008).with(&plate(&outline, [-0.0105, -0.0068], 0.0008))
}

/// The frame of the palm: a plate, the hub of the wrist, ears for three knuckles, and the root of the thumb.
pub(super) fn palm() -> Mesh {
    let hub = drum(0.0105, X, [0.0; 3], 0.022);
    let root =
        cylinder(0.0125, [-0.006, 0.008], 0.002, ROUND).along([0.7068, 0.0, 0.7074], [0.028, -0.009, 0.023]);
    let ears = [ears(0.033, 0.095), ears(0.011, 0.099), ears(-0.011, 0.095)];
    Mesh::of([&plate(&palm_outline(), [-0.0105, 0.0105], 0.0022), &hub, &root]).with(&Mesh::of(&ears))
}

/// The cover on the back of the hand.
pub(super) fn palm_back() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.013, 0.012],
        [0.018, 0.012],
        [0.03, 0.016],
        [0.0385, 0.026],
        [0.0385, 0.074],
        [0.035, 0.079],
        [-0.014, 0.079],
        [-0.0175, 0.075],
        [-0.018, 0.04],
    ]);
    plate(&outline, [0.009, 0.0128], 0.0018)
}

/// Pads below the fingers, at the thumb's root and at the heel of the hand.
pub(super) fn palm_pads() -> Mesh {
    let cushion = |half: [f64; 2], [x, z]: [f64; 2], turn: f64| {
        rounded_box([half[0], 0.0035, half[1]], 0.003, 2).turned(Y, turn).moved([x, -0.0102, z])
    };
    Mesh::of(&[
        cushion([0.0095, 0.011], [0.033, 0.0735], 0.0),
        cushion([0.0095, 0.013], [0.011, 0.0745], 0.0),
        cushion([0.0092, 0.013], [-0.011, 0.0705], 0.0),
        cushion([0.011, 0.017], [0.008, 0.038], 0.45),
        cushion([0.0125, 0.0165], [-0.0245, 0.0195], -0.5),
    ])
}

/// The bone of the little finger within the palm, which turns about an oblique axis.
pub(super) fn metacarpal() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.0255, -0.012],
        [-0.009, -0.012],
        [-0.0075, -0.008],
        [-0.0078, 0.032],
        [-0.011, 0.0355],
        [-0.023, 0.0355],
        [-0.0258, 0.031],
    ]);
    plate(&outline, [-0.0105, 0.0105], 0.0022).with(&ears(-0.017, 0.044))
}

pub(super) fn metacarpal_pad() -> Mesh {
    rounded_box([0.0085, 0.0035, 0.016], 0.003, 2).moved([-0.0165, -0.0102, 0.0125])
}

/// The cross of a knuckle: about y in the ears, about x in the finger.
pub(super) fn knuckle() -> Mesh {
    drum(0.0062, Y, [0.0; 3], 0.0066).with(&drum(0.0078, X, [0.0; 3], 0.0088))
}

pub(super) fn proximal() -> Mesh {
    phalanx(0.045, [0.0078, 0.0078])
}

pub(super) fn proximal_pad() -> Mesh {
    pad([0.0085, 0.036], 0.0082, 0.0098)
}

pub(super) fn middle() -> Mesh {
    phalanx(0.025, [0.0072, 0.0072])
}

pub(super) fn middle_pad() -> Mesh {
    pad([0.0075, 0.0185], 0.0078, 0.0078)
}

/// The last link: its tongue, its back, and the nail.
pub(super) fn distal() -> Mesh {
    let tongue = drum(0.0068, X, [0.0; 3], 0.0058);
    let back = bar(
        &[
            (0.003, [0.0052, 0.0045], 0.0005),
            (0.007, [0.0072, 0.005], 0.0012),
            (0.012, [0.0072, 0.0046], 0.0022),
            (0.022, [0.006, 0.0028], 0.0036),
            (0.0255, [0.004, 0.0012], 0.0042),
        ],
        0.0025,
        2,
    );
    tongue.with(&back)
}

pub(super) fn distal_pad() -> Mesh {
    tip(0.031, [0.0074, 0.0068], ROUND)
}

/// The thumb's lower link, from the ball in the palm to the hub.
pub(super) fn thumb_proximal() -> Mesh {
    let ball = drum(0.0105, X, [0.0; 3], 0.0095);
    let bones = bar(
        &[
            (0.004, [0.008, 0.008], 0.0),
            (0.011, [0.0105, 0.0105], 0.0),
            (0.025, [0.0105, 0.0095], 0.0),
            (0.03, [0.009, 0.0075], 0.0),
        ],
        0.004,
        2,
    );
    let cheeks = fork(0.0085, 0.038, 0.015, [0.0075, 0.0108]);
    Mesh::of([&ball, &bones, &cheeks])
}

/// A pad on the thumb's side of the palm, -x: drawn as those of the fingers and turned.
fn thumb_pad(heights: [f64; 2], half: f64, depth: f64) -> Mesh {
    pad(heights, half, depth).turned([0.0, 0.0, 1.0], -std::f64::consts::FRAC_PI_2)
}

pub(super) fn thumb_proximal_pad() -> Mesh {
    thumb_pad([0.011, 0.029], 0.0098, 0.0135)
}

/// The cross in the middle of the thumb.
pub(super) fn thumb_hub() -> Mesh {
    drum(0.0075, X, [0.0; 3], 0.0112).with(&drum(0.0065, Y, [0.0; 3], 0.0098))
}

/// The middle link. Both its joints turn about y, so that it is a link of a finger turned by 90 degrees.
pub(super) fn thumb_middle() -> Mesh {
    let upright = Mesh::of([
        &drum(0.0078, X, [0.0; 3], 0.0072),
        &bar(
            &[
                (0.004, [0.007, 0.006], 0.0008),
                (0.009, [0.0098, 0.0072], 0.0008),
                (0.021, [0.0095, 0.0068], 0.0008),
                (0.026, [0.0075, 0.0055], 0.0008),
            ],
            0.0035,
            2,
        ),
        &fork(0.0082, 0.032, 0.014, [0.0072, 0.0102]),
    ]);
    upright.turned([0.0, 0.0, 1.0], -std::f64::consts::FRAC_PI_2)
}

pub(super) fn thumb_middle_pad() -> Mesh {
    thumb_pad([0.0085, 0.0245], 0.009, 0.0108)
}

pub(super) fn thumb_distal() -> Mesh {
    distal().scaled([1.25, 1.25, 1.17]).turned([0.0, 0.0, 1.0], -std::f64::consts::FRAC_PI_2)
}

pub(super) fn thumb_distal_pad() -> Mesh {
    tip(0.0362, [0.0096, 0.0086], ROUND).turned([0.0, 0.0, 1.0], -std::f64::consts::FRAC_PI_2)
}
