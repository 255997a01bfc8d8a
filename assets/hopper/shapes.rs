//! What the links of the hopper look like, each in the frame of its body \[m\]: its joint at the origin, about y, the link below it.

use crate::shape::{hull, side};
use workshop::{Mesh, Profile, Vec3, cylinder, rounded_box};

const Y: Vec3 = [0.0, 1.0, 0.0];

/// A drum about y.
fn drum(radius: f64, z: f64, [low, high]: [f64; 2]) -> Mesh {
    cylinder(radius, [low, high], 0.004, 20).along(Y, [0.0, 0.0, z])
}

/// A link of two round ends, the second below the first.
fn bar(radii: [f64; 2], length: f64, y: [f64; 2]) -> Mesh {
    side(&Profile::link(radii, length, 8).turned(-std::f64::consts::FRAC_PI_2), y)
}

/// The body over the hip: a shell that widens to its shoulders.
pub(super) fn torso() -> Mesh {
    let sections = [
        [-0.01, 0.045, 0.05, 0.0, 0.0],
        [0.03, 0.07, 0.07, 0.0, 0.0],
        [0.12, 0.085, 0.085, 0.01, 0.0],
        [0.21, 0.088, 0.09, 0.015, 0.0],
        [0.245, 0.075, 0.08, 0.012, 0.0],
        [0.255, 0.055, 0.06, 0.01, 0.0],
    ];
    hull(2, &sections, 3.2, 24)
}

/// The window of its sensor, and the band round it.
pub(super) fn torso_dark() -> Mesh {
    let window = rounded_box([0.012, 0.055, 0.024], 0.008, 2).moved([0.094, 0.0, 0.18]);
    let cheeks = [-1.0, 1.0].map(|sign: f64| {
        let [a, b] = [sign * 0.042, sign * 0.056];
        side(&Profile::link([0.046, 0.03], 0.06, 8).turned(std::f64::consts::FRAC_PI_2), [a.min(b), a.max(b)])
    });
    Mesh::of(&cheeks).with(&window)
}

/// The thigh: two plates, and the block between them.
pub(super) fn thigh() -> Mesh {
    let plates = bar([0.04, 0.034], 0.25, [0.022, 0.03]).with(&bar([0.04, 0.034], 0.25, [-0.03, -0.022]));
    let web = rounded_box([0.018, 0.024, 0.06], 0.006, 1).moved([0.0, 0.0, -0.115]);
    plates.with(&web)
}

/// A motor at the top of a link.
pub(super) fn motor() -> Mesh {
    drum(0.036, 0.0, [-0.041, 0.041]).with(&drum(0.018, 0.0, [-0.045, 0.045]))
}

/// The shin: a slender blade.
pub(super) fn shin() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.024, 0.012],
        [0.024, 0.012],
        [0.027, -0.01],
        [0.022, -0.06],
        [0.015, -0.14],
        [0.013, -0.235],
        [0.02, -0.25],
        [0.014, -0.266],
        [-0.014, -0.266],
        [-0.02, -0.25],
        [-0.013, -0.235],
        [-0.02, -0.06],
        [-0.027, -0.01],
    ]);
    side(&outline, [-0.015, 0.015])
}

/// The foot: an arch from heel to toes.
pub(super) fn foot() -> Mesh {
    let outline = Profile::polygon(&[
        [-0.016, 0.014],
        [0.016, 0.014],
        [0.034, -0.006],
        [0.085, -0.024],
        [0.1, -0.032],
        [0.1, -0.038],
        [-0.058, -0.038],
        [-0.058, -0.028],
        [-0.03, -0.012],
    ]);
    side(&outline, [-0.032, -0.018])
        .with(&side(&outline, [0.018, 0.032]))
        .with(&rounded_box([0.012, 0.03, 0.008], 0.003, 1).moved([0.06, 0.0, -0.028]))
}

/// The rubber below heel and toes.
pub(super) fn sole() -> Mesh {
    let pad = |x: f64, half: f64| rounded_box([half, 0.038, 0.007], 0.004, 1).moved([x, 0.0, -0.043]);
    pad(-0.042, 0.02).with(&pad(0.08, 0.025))
}
