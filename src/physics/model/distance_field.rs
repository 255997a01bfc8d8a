//! What a signed distance field must tell.

use crate::math::Vec3;
use std::fmt::Debug;

/// A signed distance field in its own frame \[m\].
pub trait Field: Debug + Send + Sync {
    /// Distance of `point` from the surface, negative inside.
    fn distance(&self, point: Vec3) -> f64;

    /// Slope of the distance at `point`; forward differences where a field knows no better.
    fn gradient(&self, point: Vec3) -> Vec3 {
        const STEP: f64 = 1e-8;
        let here = self.distance(point);
        std::array::from_fn(|k| {
            let mut moved = point;
            moved[k] += STEP;
            (self.distance(moved) - here) / STEP
        })
    }

    /// A box around the surface: centre, half sizes.
    fn bounds(&self) -> [f64; 6];
}
