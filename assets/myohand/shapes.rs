//! Bones of a right hand and its forearm, in the frames of their bodies \[m\]. Bodies of the forearm and the wrist: x to the side of the thumb, y up the
//! arm, z out of the back of the hand. Bodies of thumb and fingers: x along the finger, y the axis that it bends about, z out of its back;
//! phalanges begin at the origin, metacarpals of fingers end there. Sizes are by eye.

use crate::bones::{knob, shaft};
use workshop::Mesh;

/// A bone along a finger: distances from the origin, how far its middle is to the side and above, half its width and half its height there
/// \[mm\].
fn along(stations: &[[f64; 5]]) -> Mesh {
    let path = stations.iter().map(|station| {
        let [x, y, z, wide, high] = station.map(|size| 1e-3 * size);
        ([x, y, z], [wide, high])
    });
    shaft(&path.collect::<Vec<_>>())
}

/// A bone along the arm: heights, how far its middle is to the side of the thumb and to the back, half its width and half its thickness
/// \[mm\].
fn down(stations: &[[f64; 5]]) -> Mesh {
    let path = stations.iter().map(|station| {
        let [y, x, z, wide, thick] = station.map(|size| 1e-3 * size);
        ([x, y, z], [wide, thick])
    });
    shaft(&path.collect::<Vec<_>>())
}

/// The metacarpal of a finger, whose head is at the origin, by its length \[mm\].
fn metacarpal(length: f64, thick: f64) -> Mesh {
    along(&[
        [-length, 0.0, -1.0, 1.5 * thick, 1.45 * thick],
        [-0.85 * length, 0.0, -1.0, 1.1 * thick, 1.1 * thick],
        [-0.5 * length, 0.0, 0.0, 0.8 * thick, thick],
        [-10.0, 0.0, -0.3, 1.1 * thick, 1.2 * thick],
        [-1.5, 0.0, -0.4, 1.35 * thick, 1.35 * thick],
    ])
}

/// A phalanx that ends at another joint: where that joint is and half the phalanx's thickness \[mm\].
fn phalanx([x, y, z]: [f64; 3], thick: f64) -> Mesh {
    let at = |far: f64, below: f64, wide: f64, high: f64| {
        [far * x, far * y, far * z - below, wide * thick, high * thick]
    };
    along(&[
        at(0.15, 0.8, 1.25, 1.05),
        at(0.25, 0.7, 1.05, 0.9),
        at(0.45, 0.5, 0.85, 0.75),
        at(0.7, 0.6, 0.8, 0.65),
        at(0.86, 0.8, 1.0, 0.6),
        at(0.92, 0.9, 1.05, 0.52),
    ])
}

/// The last bone of a finger: its tip and half its thickness \[mm\].
fn distal([x, y, z]: [f64; 3], thick: f64) -> Mesh {
    let at = |far: f64, below: f64, wide: f64, high: f64| {
        [far * x, far * y, far * z - below, wide * thick, high * thick]
    };
    along(&[
        at(0.18, 0.9, 1.25, 0.7),
        at(0.35, 0.7, 0.95, 0.65),
        at(0.6, 0.4, 0.75, 0.55),
        at(0.85, 0.2, 1.0, 0.45),
        at(0.95, 0.2, 0.8, 0.4),
    ])
}

/// Joints and tips of the fingers \[mm\], as `parts/hand.xml` places them; from the index finger to the little one: length of the
/// metacarpal, the middle joint, the last joint, the tip, and half the thickness of metacarpal and phalanges.
const FINGERS: [(f64, [[f64; 3]; 3], [f64; 2]); 4] = [
    (57.0, [[42.5, 2.6, 3.0], [25.1, 0.7, -1.2], [18.0, 0.2, -1.9]], [4.4, 4.3]),
    (55.0, [[44.5, 2.1, 2.8], [29.1, 1.5, -0.3], [19.0, 1.8, -2.5]], [4.4, 4.4]),
    (49.0, [[40.4, -2.6, 0.2], [24.8, -1.8, -0.2], [18.0, -0.5, 0.1]], [4.1, 4.1]),
    (45.0, [[35.8, -4.3, 1.4], [20.8, -2.7, 0.2], [17.1, -1.8, -1.6]], [3.8, 3.7]),
];

/// Bone `part` of finger `number`, counted from the index finger: metacarpal and three phalanges.
fn finger(number: usize, part: usize) -> Mesh {
    let (length, joints, [palm, thick]) = FINGERS[number];
    match part {
        0 => metacarpal(length, palm),
        1 => phalanx(joints[0], thick),
        2 => phalanx(joints[1], 0.87 * thick),
        _ => distal(joints[2], 0.75 * thick),
    }
}

/// The four bones of each finger, by names.
pub(super) mod fingers {
    use workshop::Mesh;

    macro_rules! bones {
        ($($name:ident $number:literal $part:literal;)*) => {
            $(pub fn $name() -> Mesh { super::finger($number, $part) })*
        };
    }
    bones! {
        metacarpal2 0 0; proximal2 0 1; middle2 0 2; distal2 0 3;
        metacarpal3 1 0; proximal3 1 1; middle3 1 2; distal3 1 3;
        metacarpal4 2 0; proximal4 2 1; middle4 2 2; distal4 2 3;
        metacarpal5 3 0; proximal5 3 1; middle5 3 2; distal5 3 3;
    }
}

/// The metacarpal of the thumb, which begins at the origin.
pub(super) fn thumb_metacarpal() -> Mesh {
    along(&[
        [4.5, 0.2, -0.3, 6.4, 5.5],
        [9.0, 0.6, -0.2, 5.0, 4.5],
        [18.0, 1.4, 0.2, 4.0, 4.0],
        [28.0, 2.3, 0.0, 5.2, 4.6],
        [32.5, 2.6, -0.4, 5.6, 4.8],
    ])
}

pub(super) fn thumb_proximal() -> Mesh {
    phalanx([31.1, 1.5, 0.1], 4.8)
}

pub(super) fn thumb_distal() -> Mesh {
    distal([23.7, 1.3, -0.7], 4.4)
}

/// The eight bones of the wrist.
pub(super) fn wrist() -> Mesh {
    let bones = [
        ([6.0, 6.5, 6.5], [0.0, -1.5, 0.5]),
        ([6.0, 7.5, 6.0], [11.5, -4.5, -1.0]),
        ([5.5, 6.0, 5.5], [-10.5, -7.0, -0.5]),
        ([3.5, 4.5, 3.2], [-13.5, -10.0, -9.0]),
        ([6.0, 9.0, 7.0], [3.5, -15.5, 2.0]),
        ([6.0, 6.0, 6.0], [19.5, -19.5, -6.5]),
        ([5.0, 6.0, 6.0], [12.5, -19.0, 0.5]),
        ([6.5, 7.0, 6.0], [-7.5, -18.0, 0.5]),
    ];
    let millimetres = |sizes: [f64; 3]| sizes.map(|size| 1e-3 * size);
    let parts: Vec<Mesh> =
        bones.iter().map(|(half, at)| knob(millimetres(*half), millimetres(*at))).collect();
    Mesh::of(&parts)
}

/// From beside the elbow to the wrist; its head turns about the origin.
pub(super) fn radius() -> Mesh {
    down(&[
        [4.0, 0.0, 0.0, 9.0, 9.0],
        [-4.0, 0.5, 0.0, 9.0, 9.0],
        [-14.0, 1.5, 0.5, 6.0, 6.0],
        [-30.0, 5.0, 2.0, 6.5, 7.0],
        [-100.0, 15.0, 11.0, 5.5, 6.5],
        [-170.0, 19.0, 19.0, 6.5, 6.0],
        [-205.0, 20.5, 22.5, 9.0, 6.5],
        [-226.0, 21.5, 24.0, 12.5, 8.0],
    ])
}

/// From the hook behind the elbow to the side of the little finger.
pub(super) fn ulna() -> Mesh {
    down(&[
        [14.0, -14.0, -2.0, 9.0, 9.0],
        [-2.0, -14.0, 0.0, 10.0, 9.5],
        [-25.0, -11.0, 4.0, 8.0, 8.0],
        [-100.0, -4.5, 24.0, 5.5, 6.0],
        [-180.0, 1.0, 40.0, 4.5, 4.5],
        [-226.0, 3.5, 48.5, 5.5, 5.5],
    ])
}

/// The lower end of the upper arm, with the roller that the forearm bends about.
pub(super) fn humerus() -> Mesh {
    let body = down(&[
        [-170.0, 3.0, 0.0, 10.0, 10.0],
        [-220.0, 2.0, -1.0, 10.0, 12.0],
        [-255.0, 1.0, -4.0, 8.0, 17.0],
        [-274.0, 2.0, -7.0, 8.5, 25.0],
    ]);
    let knuckles =
        [([0.011, 0.0115, 0.011], [0.006, -0.287, -0.022]), ([0.01, 0.0105, 0.0105], [0.007, -0.288, 0.006])];
    let round: Vec<Mesh> = knuckles.iter().map(|(half, at)| knob(*half, *at)).collect();
    body.with(&Mesh::of(&round))
}
