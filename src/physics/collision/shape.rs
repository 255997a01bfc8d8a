//! A geom in the world, and a point of contact before friction and softness are known.

use crate::math::{Mat3, Vec3, column};
use crate::model::{GeomType, Model};
use crate::stages::Kinematics;

/// What a narrow-phase function says about one point of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PreContact {
    /// Distance between the surfaces; negative in penetration \[m\].
    pub dist: f64,
    /// Midpoint between the surfaces, in the world.
    pub pos: Vec3,
    /// Unit normal, from the first geom to the second.
    pub normal: Vec3,
    /// Wanted direction of the first tangent; zero lets the frame choose.
    pub tangent: Vec3,
}

/// A geom placed in the world.
#[derive(Clone, Copy, Debug)]
pub struct Shape<'a> {
    /// Kind of shape.
    pub kind: GeomType,
    /// Centre, in the world \[m\].
    pub pos: Vec3,
    /// Orientation.
    pub mat: Mat3,
    /// Sizes as the geom type defines them \[m\].
    pub size: Vec3,
    /// Index of the geom.
    pub geom: usize,
    /// Where meshes and height fields live.
    pub m: &'a Model,
}

impl<'a> Shape<'a> {
    /// Geom `g` at its current pose.
    pub fn new(m: &'a Model, kin: &Kinematics, g: usize) -> Self {
        Shape {
            kind: GeomType::from_code(m.geom_type[g]).unwrap_or(GeomType::None),
            pos: kin.geom_xpos[g],
            mat: kin.geom_xmat[g],
            size: m.geom_size[g],
            geom: g,
            m,
        }
    }

    /// Mesh or height field of the geom, if it has one.
    pub fn data(&self) -> Option<usize> {
        usize::try_from(self.m.geom_dataid[self.geom]).ok()
    }

    /// The z axis: normal of a plane, axis of a capsule or cylinder.
    pub fn axis(&self) -> Vec3 {
        column(&self.mat, 2)
    }
}
