//! Bones of a right hand that points, 3.3 times as large as an adult's, in the frames of their bodies \[m\]: x along the finger, y to the side
//! of the thumb, z out of the back of the hand. Each phalanx begins at the origin; the hand's origin is the knuckle of the index finger.

use crate::bones::shaft;
use crate::hand;
use workshop::{Mesh, Vec3};

/// How much larger than an adult's the hand is.
const SCALE: f64 = 3.3;
/// The knuckle of the index finger in the frame of [`hand`] \[m\].
const KNUCKLE: Vec3 = [0.003, -0.025, -0.342];
/// How far the other fingers are bent at their joints \[rad\].
const FIST: [f64; 3] = [1.25, 1.65, 0.95];

/// A mesh of the frame with the palm forward, laid down so that the palm is below.
fn laid(mesh: Mesh) -> Mesh {
    mesh.mapped(|[x, y, z]| [-z, -y, -x])
}

/// A phalanx: distances from its joint, how far below the joint's height its middle is, half its height and half its width there.
fn phalanx(stations: &[[f64; 4]]) -> Mesh {
    let path: Vec<_> =
        stations.iter().map(|&[along, below, high, wide]| ([below, 0.0, -along], [high, wide])).collect();
    laid(shaft(&path))
}

/// Ends of the forearm, wrist, palm, thumb, and three fingers that make a fist.
pub(super) fn hand() -> Mesh {
    let [ulna, radius] = [hand::ULNA_END, hand::RADIUS_END]
        .map(|[upper, end]| shaft(&[([upper.0[0], upper.0[1], -0.155], upper.1), upper, end]));
    let fist = (1..4).flat_map(|number| hand::finger(number, &FIST));
    let rest = hand::wrist().into_iter().chain(hand::thumb()).chain(hand::finger(0, &[])).chain(fist);
    let parts: Vec<Mesh> = [ulna, radius].into_iter().chain(rest).collect();
    laid(Mesh::of(&parts).moved(KNUCKLE.map(|x| -x)).scaled([SCALE; 3]))
}

pub(super) fn proximal() -> Mesh {
    phalanx(&[
        [0.018, 0.002, 0.016, 0.019],
        [0.025, 0.002, 0.0135, 0.016],
        [0.04, 0.002, 0.01, 0.0125],
        [0.068, 0.002, 0.0088, 0.011],
        [0.085, 0.002, 0.0085, 0.0135],
        [0.092, 0.002, 0.008, 0.015],
    ])
}

pub(super) fn middle() -> Mesh {
    phalanx(&[
        [0.012, 0.001, 0.0095, 0.0145],
        [0.019, 0.0012, 0.0085, 0.0125],
        [0.033, 0.0014, 0.0078, 0.0102],
        [0.065, 0.002, 0.0072, 0.0095],
        [0.084, 0.003, 0.007, 0.0112],
        [0.093, 0.0031, 0.0068, 0.012],
    ])
}

/// The last bone, with the flat end that carries the nail.
pub(super) fn distal() -> Mesh {
    phalanx(&[
        [0.009, 0.0031, 0.007, 0.0115],
        [0.018, 0.0028, 0.0062, 0.0088],
        [0.036, 0.002, 0.005, 0.0065],
        [0.052, 0.001, 0.0045, 0.0075],
        [0.059, 0.001, 0.0042, 0.0095],
        [0.0645, 0.001, 0.0036, 0.0085],
    ])
}
