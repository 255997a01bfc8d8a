//! Bones of a right shoulder in the frames of their bodies, with the arm hanging down: x forward, y up, z to the right. Sizes are those
//! of an adult of 1.75 m, by eye; ends of bones are where the joints are.

use crate::bones::{knob, shaft};
use workshop::{Mesh, Vec3, loft};

fn metres(at: Vec3) -> Vec3 {
    at.map(|x| 1e-3 * x)
}

/// A bone through places \[mm\], each with its half thickness there.
fn bone(path: &[(Vec3, f64)]) -> Mesh {
    let path: Vec<_> = path.iter().map(|(at, thick)| (metres(*at), [1e-3 * thick; 2])).collect();
    shaft(&path)
}

/// From the breastbone, bent forward and then back, to the acromion.
pub(super) fn clavicle() -> Mesh {
    bone(&[
        ([2.0, 1.0, 4.0], 8.0),
        ([6.0, 4.0, 18.0], 6.0),
        ([8.0, 9.0, 45.0], 5.0),
        ([0.0, 14.0, 75.0], 4.8),
        ([-7.0, 17.5, 98.0], 5.0),
        ([-12.0, 20.0, 122.0], 5.5),
    ])
}

/// Blade, its thick edge below the socket, the ridge on its back with the acromion, the socket, and the hook in front.
pub(super) fn scapula() -> Mesh {
    let edge = bone(&[
        ([-36.0, -42.0, -17.0], 4.0),
        ([-56.0, -53.0, -41.0], 2.8),
        ([-74.0, -67.0, -58.0], 2.8),
        ([-88.0, -91.0, -64.0], 2.8),
        ([-107.0, -117.0, -70.0], 3.5),
    ]);
    let ridge = bone(&[
        ([-85.0, -14.0, -62.0], 3.0),
        ([-70.0, -5.0, -40.0], 4.0),
        ([-55.0, 1.0, -21.0], 4.5),
        ([-36.0, 5.0, 1.0], 5.0),
        ([-20.0, 5.0, 14.0], 5.5),
        ([-6.0, 3.0, 12.0], 5.0),
    ]);
    let socket = bone(&[([-41.0, -35.0, -22.0], 7.0), ([-33.0, -34.0, -13.0], 9.5)]);
    let hook = bone(&[([-30.0, -15.0, -20.0], 4.5), ([-8.0, -22.0, -29.0], 4.0), ([6.0, -35.0, -27.0], 4.0)]);
    Mesh::of(&[blade(), edge, ridge, socket, hook])
}

/// The thin plate between socket, upper and lower angle.
fn blade() -> Mesh {
    let outline = [
        [-36.0, -34.0, -17.0],
        [-40.0, -21.0, -30.0],
        [-50.0, -6.0, -54.0],
        [-56.0, 0.0, -73.0],
        [-73.0, -9.0, -78.0],
        [-88.0, -24.0, -76.0],
        [-100.0, -70.0, -75.0],
        [-108.0, -116.0, -71.0],
        [-88.0, -90.0, -64.0],
        [-74.0, -66.0, -58.0],
        [-56.0, -52.0, -41.0],
        [-42.0, -44.0, -21.0],
    ];
    // Across the plate: backward, and a little up and outwards.
    let side = |out: f64| -> Vec<Vec3> {
        outline.iter().map(|[x, y, z]| metres([x - 0.79 * out, y + 0.36 * out, z + 0.5 * out])).collect()
    };
    loft(&[side(1.3), side(-1.3)])
}

/// The upper half, with head and tubercles; the lower half is `myohand`'s.
pub(super) fn humerus() -> Mesh {
    let body = bone(&[
        ([0.0, 2.0, 4.0], 16.0),
        ([0.0, -18.0, 3.0], 13.0),
        ([1.0, -40.0, 1.0], 11.5),
        ([2.0, -100.0, 0.0], 10.5),
        ([3.0, -176.0, 0.0], 10.0),
    ]);
    let round = [
        ([21.0; 3], [-1.0, 1.0, -2.0]),
        ([9.0, 11.0, 8.0], [-2.0, 2.0, 15.0]),
        ([7.0, 10.0, 8.0], [13.0, 1.0, 2.0]),
    ];
    let round = round.map(|(half, at)| knob(metres(half), metres(at)));
    body.with(&Mesh::of(&round))
}
