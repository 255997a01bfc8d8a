//! What contacts of flexes are found in, and which parts of it are too far apart to touch.

use crate::collision::broad_phase::types_match;
use crate::collision::mixing;
use crate::math::Vec3;
use crate::model::flex::Flex;
use crate::model::{Disable, GeomType, Model};
use crate::stages::{Flexes, Kinematics};

/// What contacts are found in.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The model.
    pub m: &'a Model,
    /// Where bodies and geoms are.
    pub kin: &'a Kinematics,
    /// Where vertices, elements and their boxes are.
    pub flexes: &'a Flexes,
}

impl<'a> World<'a> {
    pub(super) fn flex(self, f: usize) -> Flex<'a> {
        Flex { m: self.m, id: f }
    }

    pub(super) fn middle_phase(self) -> bool {
        !self.m.opt.disableflags.contains(Disable::MIDPHASE)
    }

    /// Positions of the vertices of a flex.
    pub(super) fn points(self, f: usize) -> &'a [Vec3] {
        &self.flexes.flexvert_xpos[self.flex(f).vertices()]
    }

    /// Boxes of the elements of a flex.
    pub(super) fn boxes(self, f: usize) -> &'a [[f64; 6]] {
        &self.flexes.flexelem_aabb[self.flex(f).elements()]
    }
}

/// Distance below which two surfaces make force, given the sum of their margins.
pub(super) fn margin(m: &Model, sum: f64) -> f64 {
    if mixing::overridden(m) { m.opt.o_margin } else { sum }
}

/// Margin of a geom and a flex, and the gap beyond it.
pub(super) fn geom_reach(m: &Model, g: usize, f: usize) -> [f64; 2] {
    [margin(m, m.geom_margin[g] + m.flex_margin[f]), m.geom_gap[g] + m.flex_gap[f]]
}

/// Boxes (centre, half sizes) along the same axes that are farther apart than `margin`.
pub(super) fn boxes_apart(a: &[f64; 6], b: &[f64; 6], margin: f64) -> bool {
    (0..3).any(|k| a[k] + a[k + 3] + margin < b[k] - b[k + 3] || b[k] + b[k + 3] + margin < a[k] - a[k + 3])
}

/// A box around a ball and another box are apart.
pub(super) fn ball_apart(centre: Vec3, bound: f64, aabb: &[f64; 6]) -> bool {
    (0..3).any(|k| centre[k] + bound < aabb[k] - aabb[k + 3] || centre[k] - bound > aabb[k] + aabb[k + 3])
}

pub(super) fn geom_matches(m: &Model, g: usize, f: usize) -> bool {
    types_match(m.geom_contype[g], m.geom_conaffinity[g], m.flex_contype[f], m.flex_conaffinity[f])
}

pub(super) fn is_of_type(m: &Model, g: usize, kind: GeomType) -> bool {
    m.geom_type[g] == kind.code()
}
