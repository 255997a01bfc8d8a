//! Signed distances of geoms, and the contacts found by following them.
//!
//! A geom of type `sdf` has the field of its plugin or the octree of its mesh; other shapes have distances of their own
//! ([`solid`]). Two of them touch where descent on both distances ends inside both ([`pair`]); a mesh touches a field where
//! the deepest points of its triangles lie inside it ([`triangles`]). MuJoCo's documentation calls these collisions with
//! signed distance fields; `sdf_initpoints` and `sdf_iterations` say how long is sought.

mod octree;
mod pair;
mod solid;
mod triangles;

pub(crate) use pair::two_fields;
use triangles::Candidate;
pub(crate) use triangles::{Sheet, mesh_and_field, sheet_and_field};

use super::PreContact;
use crate::math::{
    Mat3, Quat, Vec3, add, distance, normalize, quat_conj, quat_mul, quat_normalize, quat_rotate,
    quat_to_mat, scale,
};
use crate::model::bounds::{MAXCONPAIR, MINVAL};
use crate::model::{GeomType, Model};
use crate::plugin::Field;
use octree::Octree;

/// The signed distance of one geom, in its frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Distance<'a> {
    /// A plugin's field.
    Field(&'a dyn Field),
    /// Interpolated in a mesh's octree.
    Octree(Octree<'a>),
    /// A primitive shape of these sizes.
    Solid(GeomType, Vec3),
}

impl<'a> Distance<'a> {
    /// That of geom `g`; `None` where the model has none.
    pub fn of(m: &'a Model, g: usize) -> Option<Self> {
        let kind = GeomType::from_code(m.geom_type[g])?;
        match kind {
            GeomType::Sdf if m.geom_plugin[g] >= 0 => {
                m.plugins().get(m.geom_plugin[g])?.instance.field().map(Distance::Field)
            }
            GeomType::Sdf | GeomType::Mesh => {
                Octree::of(m, usize::try_from(m.geom_dataid[g]).ok()?).map(Distance::Octree)
            }
            GeomType::Hfield | GeomType::None => None,
            _ => Some(Distance::Solid(kind, m.geom_size[g])),
        }
    }

    /// The distance at `p`.
    pub fn at(&self, p: Vec3) -> f64 {
        match self {
            Distance::Field(field) => field.distance(p),
            Distance::Octree(octree) => octree.distance(p),
            Distance::Solid(kind, size) => solid::distance(*kind, *size, p),
        }
    }

    /// The slope of the distance at `p`.
    pub fn gradient(&self, p: Vec3) -> Vec3 {
        match self {
            Distance::Field(field) => field.gradient(p),
            Distance::Octree(octree) => octree.gradient(p),
            Distance::Solid(kind, size) => solid::gradient(*kind, *size, p),
        }
    }
}

/// The larger number; the first of equal ones.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b { a } else { b }
}

/// The smaller number; the first of equal ones.
fn smaller(a: f64, b: f64) -> f64 {
    if a <= b { a } else { b }
}

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

/// Working memory of contacts with fields, reused from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct FieldScratch {
    /// Points that are contacts already.
    known: Vec<Vec3>,
    /// Points of a triangle, or of all of a mesh, that lie inside.
    candidates: Vec<Candidate>,
    /// Triangles of a sheet with their deepest points.
    deepest: Vec<(usize, Candidate)>,
    /// Which triangle of the sheet each contact belongs to.
    pub elements: Vec<usize>,
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
