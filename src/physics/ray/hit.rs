//! Rays, and where they hit.

use crate::math::{Mat3, Vec3, mul_mat_t_vec, mul_mat_vec, normalize, sub};

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes; its length is the unit of distance.
    pub direction: Vec3,
}

/// Intersection of a ray with a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub distance: f64,
    /// Outward unit normal of the surface, world frame.
    pub normal: Vec3,
}

impl Ray {
    /// Point at distance `x`.
    pub fn at(&self, x: f64) -> Vec3 {
        std::array::from_fn(|k| self.origin[k] + x * self.direction[k])
    }

    /// The ray in the frame at `pos` with orientation `mat`.
    pub(super) fn local(&self, pos: Vec3, mat: &Mat3) -> Ray {
        Ray {
            origin: mul_mat_t_vec(mat, sub(self.origin, pos)),
            direction: mul_mat_t_vec(mat, self.direction),
        }
    }
}

/// Intersection in the frame of a shape; the normal has any length.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalHit {
    pub distance: f64,
    pub normal: Vec3,
}

/// Keeps the nearer of two intersections, the first one when they are equally far.
pub(super) fn keep_nearer(best: &mut Option<LocalHit>, candidate: LocalHit) {
    if best.is_none_or(|b| candidate.distance < b.distance) {
        *best = Some(candidate);
    }
}

impl LocalHit {
    pub(super) fn global(self, mat: &Mat3) -> Hit {
        Hit { distance: self.distance, normal: mul_mat_vec(mat, normalize(self.normal).0) }
    }
}
