//! Solids of three sizes that are no primitives: pyramids and tori.

use crate::shape::Shape;
use workshop::{Mesh, Vec3, loft, revolve, sincos};

pub(crate) const MESHES: &[Shape] = &[
    ("pyramidlarge", || pyramid(0.1017)),
    ("pyramidmedium", || pyramid(0.0813)),
    ("pyramidsmall", || pyramid(0.0406)),
    ("toruslarge", || torus(0.0608, 0.0202)),
    ("torusmedium", || torus(0.0403, 0.01335)),
    ("torussmall", || torus(0.02055, 0.0068)),
];

/// A pyramid as wide as it is high, its middle at the origin.
fn pyramid(size: f64) -> Mesh {
    let ring = |half: f64, height: f64| -> Vec<Vec3> {
        [[half, half], [-half, half], [-half, -half], [half, -half]].map(|[x, y]| [x, y, height]).to_vec()
    };
    loft(&[ring(size / 2.0, -size / 2.0), ring(0.0, size / 2.0)])
}

/// A torus round z by its outer radius and the radius of its ring.
fn torus(outer: f64, ring: f64) -> Mesh {
    let place = |step: u32| {
        let (sine, cosine) = sincos(std::f64::consts::TAU * f64::from(step % 10) / 10.0);
        [outer - ring + ring * cosine, ring * sine]
    };
    revolve(&(0..=10).map(place).collect::<Vec<_>>(), 22)
}
