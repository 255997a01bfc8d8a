//! Bones of two legs, their pelvis and a trunk, in the frames of their bodies \[m\]. Of legs and pelvis: x forward, y up, z to the right;
//! of the trunk: x forward, y to the left, z up. What a body has twice is drawn for the right side. Sizes are those of an adult of 1.7 m, by
//! eye.

use crate::bones::{knob, long, shaft};
use workshop::{Mesh, Vec3, loft, sincos};

/// Both hip bones, the sacrum and the lowest vertebrae.
pub(super) fn pelvis() -> Mesh {
    let right = hip_bone();
    let sacrum = shaft(&[
        ([-0.105, 0.05, 0.0], [0.018, 0.03]),
        ([-0.12, 0.025, 0.0], [0.017, 0.04]),
        ([-0.142, -0.02, 0.0], [0.01, 0.026]),
        ([-0.148, -0.055, 0.0], [0.006, 0.012]),
        ([-0.14, -0.078, 0.0], [0.004, 0.006]),
    ]);
    Mesh::of(&[right.clone().mirrored(2), right, sacrum])
}

/// The crest of the ilium, from the front to the back.
const CREST: [Vec3; 5] = [
    [0.0, 0.008, 0.116],
    [-0.038, 0.042, 0.119],
    [-0.074, 0.053, 0.089],
    [-0.112, 0.046, 0.068],
    [-0.143, 0.024, 0.046],
];

/// The wing of the ilium, thin and hollow inside: a strip from the socket to each point of the crest.
fn wing() -> Mesh {
    // How far the middle of a strip is above and outside of a straight line: there is a notch below the hindmost.
    let bow = [[0.0, 0.006], [0.0, 0.01], [0.0, -0.008], [0.006, -0.008], [0.02, -0.004]];
    let strip = |(number, (end, [up, out])): (i32, (Vec3, [f64; 2]))| {
        let root = [-0.05 - 0.007 * f64::from(number), -0.054 + 0.3 * up, 0.066];
        let outside = [-0.15 * f64::from(number), 0.0, 1.0];
        let place = |(share, thick): (f64, f64)| {
            let bowed = 4.0 * share * (1.0 - share);
            let line = [0, 1, 2].map(|i| root[i] + share * (end[i] - root[i]));
            [line[0] + thick * outside[0], line[1] + bowed * up, line[2] + bowed * out + thick * outside[2]]
        };
        let shares = [(0.0, 0.009), (0.35, 0.004), (0.7, 0.0025), (1.0, 0.003)];
        let inner = shares.into_iter().rev().map(|(share, thick)| (share, -thick));
        shares.into_iter().chain(inner).map(place).collect()
    };
    let strips: Vec<Vec<Vec3>> = (0..).zip(CREST.into_iter().zip(bow)).map(strip).collect();
    loft(&strips)
}

/// The wing of the ilium and its crest, the socket of the hip, and the branches of pubis and ischium.
fn hip_bone() -> Mesh {
    let mut parts = vec![wing()];
    parts.push(shaft(&CREST.map(|at| (at, [0.006, 0.006]))));
    parts.push(knob([0.021, 0.02, 0.015], [-0.062, -0.068, 0.058]));
    parts.push(shaft(&[
        ([-0.04, -0.08, 0.056], [0.008, 0.0075]),
        ([-0.022, -0.085, 0.034], [0.0065, 0.006]),
        ([-0.008, -0.09, 0.012], [0.009, 0.009]),
        ([-0.018, -0.1, 0.013], [0.005, 0.006]),
        ([-0.05, -0.112, 0.027], [0.0045, 0.0055]),
        ([-0.074, -0.113, 0.045], [0.0065, 0.007]),
    ]));
    parts.push(shaft(&[
        ([-0.088, -0.112, 0.052], [0.0095, 0.0105]),
        ([-0.076, -0.085, 0.06], [0.0095, 0.0105]),
    ]));
    Mesh::of(&parts)
}

/// Head, neck, shaft and the two condyles of the knee.
pub(super) fn femur() -> Mesh {
    let body = shaft(&[
        ([-0.008, -0.01, 0.049], [0.0115, 0.0105]),
        ([-0.004, -0.045, 0.042], [0.0115, 0.0115]),
        ([0.012, -0.14, 0.031], [0.0115, 0.0115]),
        ([0.015, -0.24, 0.02], [0.0115, 0.0115]),
        ([0.009, -0.325, 0.008], [0.0125, 0.0145]),
        ([0.004, -0.365, 0.001], [0.0125, 0.0195]),
        ([0.004, -0.38, 0.0], [0.014, 0.033]),
    ]);
    let neck = shaft(&[([-0.002, -0.008, 0.012], [0.013, 0.012]), ([-0.004, -0.02, 0.042], [0.011, 0.012])]);
    let condyle = |side: f64| knob([0.02, 0.02, 0.0145], [-0.004, -0.392, 0.023 * side]);
    let groove = knob([0.013, 0.02, 0.024], [0.01, -0.386, 0.0]);
    Mesh::of(&[body, neck, knob([0.0215; 3], [0.0; 3]), condyle(1.0), condyle(-1.0), groove])
}

/// The shin bone, from the plateau of the knee to the inner ankle.
pub(super) fn tibia() -> Mesh {
    let body = shaft(&[
        ([-0.002, -0.023, 0.0], [0.015, 0.031]),
        ([0.0, -0.033, 0.0], [0.015, 0.029]),
        ([0.009, -0.06, 0.0], [0.013, 0.015]),
        ([0.009, -0.1, -0.001], [0.012, 0.0115]),
        ([0.006, -0.16, -0.002], [0.0105, 0.01]),
        ([-0.001, -0.28, -0.005], [0.0085, 0.0085]),
        ([-0.004, -0.35, -0.006], [0.009, 0.0105]),
        ([-0.006, -0.38, -0.007], [0.013, 0.015]),
    ]);
    let ankle =
        shaft(&[([-0.004, -0.378, -0.019], [0.008, 0.005]), ([-0.004, -0.396, -0.022], [0.0065, 0.004])]);
    Mesh::of(&[body, knob([0.008, 0.013, 0.009], [0.023, -0.064, 0.0]), ankle])
}

/// The thin bone beside the shin, down to the outer ankle.
pub(super) fn fibula() -> Mesh {
    long([-0.022, -0.046, 0.033], [-0.0125, -0.402, 0.027], 0.0048, [0.0075, 0.0065])
}

pub(super) fn patella() -> Mesh {
    shaft(&[
        ([0.0, 0.014, 0.0], [0.009, 0.016]),
        ([0.001, 0.002, 0.0], [0.0105, 0.0195]),
        ([-0.001, -0.014, 0.0], [0.006, 0.009]),
    ])
}

/// The bone between the ankles.
pub(super) fn talus() -> Mesh {
    let neck = shaft(&[([0.01, -0.008, -0.002], [0.012, 0.012]), ([0.032, -0.016, -0.01], [0.009, 0.01])]);
    knob([0.021, 0.012, 0.016], [0.0, -0.008, 0.002]).with(&neck)
}

/// Heel bone, the small bones of the instep, and the long ones before the toes.
pub(super) fn foot() -> Mesh {
    let heel = shaft(&[
        ([-0.012, 0.004, -0.004], [0.016, 0.014]),
        ([0.012, 0.012, -0.003], [0.017, 0.014]),
        ([0.045, 0.018, 0.002], [0.013, 0.014]),
        ([0.068, 0.012, 0.01], [0.01, 0.011]),
    ]);
    let mut parts = vec![heel];
    for (at, half) in [
        ([0.088, 0.026, -0.016], [0.009, 0.012, 0.016]),
        ([0.084, 0.019, 0.016], [0.013, 0.009, 0.011]),
        ([0.106, 0.023, -0.02], [0.012, 0.01, 0.009]),
        ([0.104, 0.022, -0.004], [0.01, 0.009, 0.008]),
    ] {
        parts.push(knob(half, at));
    }
    for toe in 0..5 {
        let [at, _] = toe_root(toe);
        let number = f64::from(toe);
        let start = [0.118 - 0.006 * number, 0.019 - 0.0025 * number, -0.022 + 0.0115 * number];
        let end = [at[0] + 0.174, at[1] + 0.003, at[2] + 0.001];
        let thick = if toe == 0 { 0.0068 } else { 0.0045 };
        parts.push(shaft(&[
            (start, [1.3 * thick; 2]),
            ([0, 1, 2].map(|i| 0.5 * (start[i] + end[i])), [0.85 * thick; 2]),
            (end, [1.2 * thick; 2]),
        ]));
    }
    Mesh::of(&parts)
}

/// Where a toe begins, in the frame of the toes, and how long it is.
fn toe_root(toe: i32) -> [Vec3; 2] {
    let number = f64::from(toe);
    let first = if toe == 0 { 0.054 } else { 0.05 - 0.0055 * number };
    [
        [0.004 - 0.011 * number, -0.001 * number, -0.027 + 0.0185 * number],
        [first, 0.0, 0.004 - 0.002 * number],
    ]
}

pub(super) fn toes() -> Mesh {
    let toe = |toe: i32| {
        let ([at, along], thick) = (toe_root(toe), if toe == 0 { 0.0075 } else { 0.005 });
        let place = |share: f64, lift: f64| {
            [at[0] + share * along[0], at[1] - 0.004 * share + lift, at[2] + share * along[2]]
        };
        shaft(&[
            (place(0.08, 0.0), [1.1 * thick; 2]),
            (place(0.45, 0.001), [0.75 * thick; 2]),
            (place(0.95, -0.002), [0.7 * thick; 2]),
        ])
    };
    let all: Vec<Mesh> = (0..5).map(toe).collect();
    Mesh::of(&all)
}

/// Spine, ribs and breastbone of the trunk, whose origin is that of the pelvis.
pub(super) fn trunk() -> Mesh {
    let mut spine = Vec::new();
    for level in 0..14 {
        let number = f64::from(level);
        let height = 0.066 + 0.042 * number;
        let back = -0.112 - 0.022 * sincos(0.5 * number).0 + 0.0045 * (number - 7.0).max(0.0);
        let wide = 0.021 - 0.0008 * number;
        spine.push(([back, 0.0, height - 0.011], [0.017, wide]));
        spine.push(([back - 0.004, 0.0, height + 0.012], [0.009, 0.6 * wide]));
    }
    let mut parts = vec![shaft(&spine)];
    for rib in 0..7 {
        let number = f64::from(rib);
        let (top, wide) = (0.485 - 0.037 * number, 0.078 + 0.0095 * number.min(5.0));
        let place = |step: i32| {
            let angle = f64::from(step) / 4.0 * std::f64::consts::PI * if rib < 6 { 0.97 } else { 0.75 };
            let (sine, cosine) = sincos(angle);
            let forward = -0.115 + (1.0 - cosine) * 0.5 * (0.135 + 0.004 * number);
            ([forward, wide * sine + 0.014, top - 0.02 * angle], [0.0042, 0.0055])
        };
        let side = shaft(&(0..=4).map(place).collect::<Vec<_>>());
        parts.push(side.clone().mirrored(1));
        parts.push(side);
    }
    parts.push(shaft(&[
        ([0.012, 0.0, 0.44], [0.006, 0.02]),
        ([0.03, 0.0, 0.36], [0.005, 0.015]),
        ([0.034, 0.0, 0.25], [0.005, 0.014]),
    ]));
    let shoulder = shaft(&[
        ([0.004, 0.015, 0.452], [0.009, 0.008]),
        ([0.0, 0.07, 0.468], [0.006, 0.006]),
        ([-0.05, 0.15, 0.48], [0.007, 0.006]),
    ]);
    let blade = shaft(&[
        ([-0.135, 0.1, 0.455], [0.006, 0.034]),
        ([-0.142, 0.095, 0.4], [0.004, 0.03]),
        ([-0.138, 0.085, 0.33], [0.004, 0.009]),
    ]);
    parts.extend([shoulder.clone().mirrored(1), shoulder, blade.clone().mirrored(1), blade]);
    Mesh::of(&parts)
}

/// Cranium, face and jaw, in the trunk's frame.
pub(super) fn skull() -> Mesh {
    let cranium = knob([0.092, 0.07, 0.078], [-0.06, 0.0, 0.71]);
    let face = shaft(&[
        ([-0.002, 0.0, 0.7], [0.03, 0.048]),
        ([0.008, 0.0, 0.655], [0.028, 0.042]),
        ([0.012, 0.0, 0.622], [0.02, 0.03]),
    ]);
    let side = shaft(&[
        ([-0.048, 0.053, 0.665], [0.013, 0.007]),
        ([-0.036, 0.047, 0.617], [0.015, 0.008]),
        ([0.008, 0.022, 0.603], [0.012, 0.012]),
        ([0.02, 0.002, 0.602], [0.01, 0.013]),
    ]);
    Mesh::of(&[cranium, face, side.clone().mirrored(1), side])
}
