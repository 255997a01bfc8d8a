//! The signed distance of a geom, by whatever tells it.

use super::octree::Octree;
use super::solid;
use crate::math::Vec3;
use crate::model::{Field, GeomType, Model};

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
