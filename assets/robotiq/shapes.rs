//! What the links of the Robotiq 2F-85 look like, each in the frame of its body \[m\]: fingers open along y. The pins of the four bars
//! are the maker's; outlines are judged from photographs.

use crate::dynamixel::across;
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, loft, rounded_box};

const X: Vec3 = [1.0, 0.0, 0.0];
/// Where the coupler is pinned to the driver, seen along x.
const ELBOW: [f64; 2] = [0.0315, -0.0041];
/// Where the follower is pinned to the coupler, in the driver's frame.
const KNUCKLE: [f64; 2] = [0.0376, 0.0435];
/// Where the spring link is pinned to the follower, in the link's frame.
const INNER: [f64; 2] = [0.037, 0.044];

/// A bar of two round ends, drawn in the plane of y and z.
fn bar(from: [f64; 2], to: [f64; 2], radii: [f64; 2], x: [f64; 2]) -> Mesh {
    let [dy, dz] = [to[0] - from[0], to[1] - from[1]];
    let outline = Profile::link(radii, dy.hypot(dz), 6).turned(dz.atan2(dy)).moved(from);
    across(extrude(&outline, &[], x))
}

/// The same part on either side.
fn both(part: &Mesh) -> Mesh {
    part.clone().with(&part.clone().mirrored(0))
}

/// A pin along x through a place in the plane of y and z.
fn pin([y, z]: [f64; 2], radius: f64, half: f64) -> Mesh {
    cylinder(radius, [-half, half], 0.0008, 12).along(X, [0.0, y, z])
}

/// A side of the body: a ring of its outline at a height.
fn ring((half, exponent, height): ([f64; 2], f64, f64)) -> Vec<Vec3> {
    let outline = Profile::superellipse(half, exponent, 28);
    outline.points().iter().map(|[x, y]| [*x, *y, height]).collect()
}

/// The coupling between flange and gripper.
pub(super) fn mount() -> Mesh {
    cylinder(0.0375, [0.0, 0.0108], 0.0015, 28)
}

/// The body: round at the coupling, flat between the fingers, which are hinged in its shoulders.
pub(super) fn base() -> Mesh {
    let rings = [
        ([0.0355, 0.0355], 2.0, 0.0),
        ([0.0375, 0.0375], 2.0, 0.002),
        ([0.0375, 0.0375], 2.0, 0.016),
        ([0.0345, 0.0385], 2.2, 0.024),
        ([0.0285, 0.0405], 2.8, 0.036),
        ([0.0255, 0.041], 3.5, 0.046),
        ([0.025, 0.0375], 4.0, 0.052),
        ([0.025, 0.032], 4.0, 0.056),
    ];
    let cheek = Profile::polygon(&[
        [-0.04, 0.05],
        [0.04, 0.05],
        [0.0395, 0.056],
        [0.034, 0.0632],
        [0.027, 0.064],
        [0.019, 0.0695],
        [-0.019, 0.0695],
        [-0.027, 0.064],
        [-0.034, 0.0632],
        [-0.0395, 0.056],
    ]);
    loft(&rings.map(ring)).with(&both(&across(extrude(&cheek, &[], [0.0165, 0.0245]))))
}

/// The ring round the body, the heads of the pins of its hinges, and the plate between the fingers.
pub(super) fn base_grey() -> Mesh {
    let pins = [0.0306, -0.0306].map(|y| pin([y, 0.0549], 0.0052, 0.0255));
    let inner = [0.0132, -0.0132].map(|y| pin([y, 0.0609], 0.0042, 0.0255));
    let band = cylinder(0.038, [0.0085, 0.0115], 0.0006, 28);
    Mesh::of(pins.iter().chain(&inner)).with(&band)
}

/// The crank that the motor turns: two cheeks.
pub(super) fn driver() -> Mesh {
    let web = bar([0.0, 0.0], ELBOW, [0.0085, 0.0075], [-0.006, 0.006]);
    both(&bar([0.0, 0.0], ELBOW, [0.0095, 0.0085], [0.0095, 0.0155]))
        .with(&web)
        .with(&pin(ELBOW, 0.0045, 0.0168))
}

/// The outer finger, bowed outwards, from the crank to the fingertip.
pub(super) fn coupler() -> Mesh {
    let outline = Profile::polygon(&[
        [0.0265, -0.008],
        [0.034, -0.0105],
        [0.0395, -0.006],
        [0.044, 0.008],
        [0.0472, 0.025],
        [0.0462, 0.0445],
        [0.0425, 0.0498],
        [0.0365, 0.0498],
        [0.0325, 0.0455],
        [0.0335, 0.032],
        [0.0325, 0.018],
        [0.0265, 0.001],
    ]);
    across(extrude(&outline, &[], [-0.0092, 0.0092])).with(&pin(KNUCKLE, 0.0048, 0.0145))
}

/// The inner bar, which keeps the fingertip upright.
pub(super) fn spring_link() -> Mesh {
    let cheeks = both(&bar([0.0, 0.0], INNER, [0.0075, 0.0062], [0.0105, 0.0145]));
    let web = bar([0.006, 0.0072], [0.024, 0.0286], [0.005, 0.005], [-0.0106, 0.0106]);
    cheeks.with(&web).with(&pin(INNER, 0.0036, 0.0152))
}

/// The fingertip: an arm over both pins, and the upright plate that carries the pad.
pub(super) fn follower() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.0215, -0.0005],
        [-0.0165, -0.0005],
        [-0.006, -0.0065],
        [0.003, -0.0062],
        [0.0065, 0.0],
        [0.0045, 0.006],
        [-0.004, 0.012],
        [-0.0085, 0.022],
        [-0.0115, 0.05],
        [-0.0145, 0.0525],
        [-0.0178, 0.0525],
        [-0.0178, 0.0105],
        [-0.0215, 0.0085],
    ]);
    let cheeks = both(&across(extrude(&outline, &[], [0.0093, 0.0104])));
    let back = rounded_box([0.0108, 0.0032, 0.0205], 0.0012, 2).moved([0.0, -0.0146, 0.0322]);
    cheeks.with(&across(extrude(&outline, &[], [-0.0045, 0.0045]))).with(&back)
}

/// The rubber: ridges across a plate, its face 25.5 mm inside of the knuckle.
pub(super) fn pad() -> Mesh {
    let plate = rounded_box([0.011, 0.0031, 0.0187], 0.001, 2).moved([0.0, -0.0208, 0.0322]);
    let ridges: Vec<Mesh> = (0..8)
        .map(|row| {
            let height = 0.0322 + 0.0045 * (f64::from(row) - 3.5);
            rounded_box([0.0105, 0.0012, 0.0015], 0.0006, 1).moved([0.0, -0.0243, height])
        })
        .collect();
    plate.with(&Mesh::of(&ridges))
}
