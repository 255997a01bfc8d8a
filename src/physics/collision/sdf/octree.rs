//! Distances interpolated between the corners of the cells of an octree; outside, from the nearest point of its box.

use super::order::larger;
use crate::math::Vec3;
use crate::model::Model;

/// The octree of a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Octree<'a> {
    aabb: &'a [[f64; 6]],
    child: &'a [[i32; 8]],
    coeff: &'a [[f64; 8]],
}

/// A point projected into the box of an octree stands this far inside \[m\].
const INSIDE: f64 = 1e-6;
/// Step of differences outside of the box \[m\].
const STEP: f64 = 1e-8;

/// The leaf that holds a point, and where in it, from 0 to 1 along each axis.
struct Place {
    leaf: usize,
    at: Vec3,
}

impl<'a> Octree<'a> {
    /// That of a mesh, if it has one.
    pub fn of(m: &'a Model, mesh: usize) -> Option<Self> {
        let first = usize::try_from(m.mesh_octadr[mesh]).ok()?;
        let cells = first..first + m.mesh_octnum[mesh] as usize;
        Some(Octree {
            aabb: &m.oct_aabb[cells.clone()],
            child: &m.oct_child[cells.clone()],
            coeff: &m.oct_coeff[cells],
        })
    }

    pub fn distance(&self, p: Vec3) -> f64 {
        let (inner, beyond) = self.project(p);
        let Place { leaf, at } = self.find(inner);
        let coeff = &self.coeff[leaf];
        let inside = (0..8).fold(0.0, |sum, corner| sum + weight(corner, at) * coeff[corner]);
        if beyond > 0.0 { inside + beyond } else { inside }
    }

    pub fn gradient(&self, p: Vec3) -> Vec3 {
        let (inner, beyond) = self.project(p);
        if beyond <= 0.0 {
            let Place { leaf, at } = self.find(inner);
            let coeff = &self.coeff[leaf];
            return std::array::from_fn(|axis| {
                (0..8).fold(0.0, |sum, corner| sum + slope(corner, axis, at) * coeff[corner])
            });
        }
        let here = self.distance(p);
        std::array::from_fn(|k| {
            let mut moved = p;
            moved[k] += STEP;
            (self.distance(moved) - here) / STEP
        })
    }

    /// The point, moved into the box where it lies outside, and how far outside it is; negative inside.
    fn project(&self, mut p: Vec3) -> (Vec3, f64) {
        let whole = &self.aabb[0];
        let from: Vec3 = std::array::from_fn(|k| p[k] - whole[k]);
        let beyond: Vec3 = std::array::from_fn(|k| from[k].abs() - whole[k + 3]);
        if beyond.iter().all(|&q| q <= 0.0) {
            return (p, larger(beyond[0], larger(beyond[1], beyond[2])));
        }
        let mut squared = 0.0;
        for k in (0..3).filter(|&k| beyond[k] >= 0.0) {
            squared += beyond[k] * beyond[k];
            let back = beyond[k] + INSIDE;
            p[k] -= if from[k] > 0.0 { back } else { -back };
        }
        (p, squared.sqrt())
    }

    /// Descends to the leaf that holds `p`. A point that is not a number stays in the whole.
    fn find(&self, p: Vec3) -> Place {
        let mut cell = 0;
        loop {
            let box_of = &self.aabb[cell];
            let at: Vec3 = std::array::from_fn(|k| {
                let (low, high) = (box_of[k] - box_of[k + 3], box_of[k] + box_of[k + 3]);
                (p[k] - low) / (high - low)
            });
            let slot = (0..3).fold(0, |slot, k| slot | usize::from(at[k] >= 0.5) << k);
            match usize::try_from(self.child[cell][slot]) {
                Ok(next) => cell = next,
                Err(_) => return Place { leaf: cell, at },
            }
        }
    }
}

/// `t` for an upper corner, `1 - t` for a lower one.
fn share(corner: usize, axis: usize, at: Vec3) -> f64 {
    if corner >> axis & 1 == 1 { at[axis] } else { 1.0 - at[axis] }
}

fn weight(corner: usize, at: Vec3) -> f64 {
    share(corner, 0, at) * share(corner, 1, at) * share(corner, 2, at)
}

/// Slope of the weight along an axis, in units of the cell, as MuJoCo leaves it: the direction alone counts.
fn slope(corner: usize, axis: usize, at: Vec3) -> f64 {
    let factor = |k: usize| match k == axis {
        true if corner >> k & 1 == 1 => 1.0,
        true => -1.0,
        false => share(corner, k, at),
    };
    factor(0) * factor(1) * factor(2)
}
