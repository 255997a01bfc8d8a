//! Signed distances of geoms, and the contacts found by following them.
//!
//! A geom of type `sdf` has the field of its plugin or the octree of its mesh; other shapes have distances of their own
//! ([`solid`]). Two of them touch where descent on both distances ends inside both ([`pair`]); a mesh touches a field where
//! the deepest points of its triangles lie inside it ([`triangles`]). MuJoCo's documentation calls these collisions with
//! signed distance fields; `sdf_initpoints` and `sdf_iterations` say how long is sought.

mod distance;
mod octree;
mod order;
mod pair;
mod solid;
mod triangles;

pub(crate) use distance::Distance;
pub(crate) use pair::two_fields;
pub(crate) use triangles::{Sheet, mesh_and_field, sheet_and_field};

use super::shape::PreContact;
use crate::math::{
    Mat3, Quat, Vec3, add, distance, normalize, quat_conj, quat_mul, quat_normalize, quat_rotate,
    quat_to_mat, scale,
};
use crate::model::bounds::{MAXCONPAIR, MINVAL};

/// Number `index` of the sequence of Halton that spreads over (0, 1) in a base.
fn halton(index: usize, base: usize) -> f64 {
    let step = base as f64;
    let (mut left, mut digit, mut sum) = (index, 1.0 / step, 0.0);
    while left > 0 {
        sum += digit * (left % base) as f64;
        digit /= step;
        left /= base;
    }
    sum
}

/// From one frame to another.
#[derive(Clone, Copy, Debug)]
struct Transfer {
    offset: Vec3,
    turn: Mat3,
}

impl Transfer {
    /// From the frame of the first pose to the frame of the second.
    fn new((pos, quat): (Vec3, Quat), (base, orientation): (Vec3, Quat)) -> Self {
        let back = quat_conj(orientation);
        let origin = scale(quat_rotate(back, base), -1.0);
        let turn = quat_to_mat(quat_normalize(quat_mul(back, quat)));
        Transfer { offset: add(quat_rotate(back, pos), origin), turn }
    }

    fn point(&self, p: Vec3) -> Vec3 {
        add(crate::math::mul_mat_vec(&self.turn, p), self.offset)
    }
}

/// Contacts in the frame of a field, each point once.
struct Points<'o> {
    pos: Vec3,
    quat: Quat,
    /// Normals point out of the field.
    outward: bool,
    known: &'o mut Vec<Vec3>,
    out: &'o mut Vec<PreContact>,
}

impl<'o> Points<'o> {
    fn new((pos, quat): (Vec3, Quat), known: &'o mut Vec<Vec3>, out: &'o mut Vec<PreContact>) -> Self {
        known.clear();
        Points { pos, quat, outward: false, known, out }
    }

    /// Adds a contact at `p`, in the frame of the field, if it lies inside; `slope` is that of
    /// the distance there. True when it was added.
    fn add(&mut self, p: Vec3, depth: f64, slope: impl FnOnce() -> Vec3) -> bool {
        if depth > 0.0
            || self.known.len() >= MAXCONPAIR
            || self.known.iter().any(|q| distance(p, *q) < MINVAL)
        {
            return false;
        }
        let (normal, length) = normalize(slope());
        if length < MINVAL {
            return false;
        }
        self.known.push(p);
        let normal = quat_rotate(self.quat, if self.outward { normal } else { scale(normal, -1.0) });
        let pos = add(quat_rotate(self.quat, p), self.pos);
        let pos = add(pos, scale(normal, -0.5 * depth));
        self.out.push(PreContact { dist: depth, pos, normal, tangent: [0.0; 3] });
        true
    }
}
