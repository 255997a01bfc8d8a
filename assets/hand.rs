//! Bones of a right hand, those of an adult of 1.75 m by eye \[m\]: x forward out of the palm, y to the side of the little finger, z up, the fingers down. The
//! elbow is at the origin, the wrist 0.25 m below it.

use crate::bones::{knob, long};
use workshop::{Mesh, Vec3, sincos};

/// The lower ends of the two bones of the forearm: places and half widths, as [`shaft`](crate::bones::shaft) takes them.
pub(crate) const ULNA_END: [(Vec3, [f64; 2]); 2] =
    [([-0.003, 0.017, -0.225], [0.0055, 0.0055]), ([-0.002, 0.017, -0.243], [0.0075, 0.0075])];
pub(crate) const RADIUS_END: [(Vec3, [f64; 2]); 2] =
    [([0.001, -0.018, -0.2], [0.0075, 0.0085]), ([0.0, -0.013, -0.243], [0.01, 0.014])];

/// From the index finger to the little one: where the metacarpal begins (y), how far the finger leads aside over 0.16 m, and the
/// lengths of the metacarpal and three phalanges \[m\].
const FINGERS: [(f64, f64, [f64; 4]); 4] = [
    (-0.02, -0.013, [0.062, 0.04, 0.024, 0.017]),
    (-0.006, -0.002, [0.06, 0.044, 0.028, 0.018]),
    (0.007, 0.008, [0.054, 0.041, 0.026, 0.018]),
    (0.018, 0.018, [0.049, 0.033, 0.019, 0.016]),
];

/// The eight bones of the wrist.
pub(crate) fn wrist() -> Vec<Mesh> {
    let bone = |place: u32| {
        let (row, side) = (f64::from(place / 4), -0.018 + 0.012 * f64::from(place % 4));
        knob([0.008, 0.0075, 0.008], [0.002, side, -0.258 - 0.013 * row])
    };
    (0..8).map(bone).collect()
}

/// A finger's metacarpal, and a phalanx for each of `bends`: how far it is bent against the bone before it \[rad\]. Finger 0 is the
/// index finger.
pub(crate) fn finger(number: usize, bends: &[f64]) -> Vec<Mesh> {
    let (start, aside, lengths) = FINGERS[number];
    let (mut from, mut bend) = ([0.003, start, -0.28], 0.0_f64);
    let mut bones = Vec::new();
    for (bone, joint) in [0.0].iter().chain(bends).enumerate() {
        bend += joint;
        let (sine, cosine) = sincos(bend);
        let length = lengths[bone];
        let to = [from[0] + length * sine, from[1] + aside * length / 0.16, from[2] - length * cosine];
        let thick = [0.0042, 0.0038, 0.0034, 0.003][bone];
        bones.push(long(from, to, thick, [1.5 * thick, 1.45 * thick]));
        from = to;
    }
    bones
}

/// The thumb, relaxed, with its metacarpal.
pub(crate) fn thumb() -> Vec<Mesh> {
    let joints: [Vec3; 4] =
        [[0.008, -0.024, -0.268], [0.022, -0.044, -0.298], [0.03, -0.056, -0.324], [0.035, -0.062, -0.345]];
    let bone = |(pair, thick): (&[Vec3], f64)| long(pair[0], pair[1], thick, [1.5 * thick, 1.4 * thick]);
    joints.windows(2).zip([0.0047, 0.0042, 0.0036]).map(bone).collect()
}
