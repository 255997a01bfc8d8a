//! Contacts of a height field: each grid triangle, extended down to the base, is a convex prism.

use super::{PreContact, convex::ConvexScratch};
use crate::data::Kinematics;
use crate::model::Model;

/// Height field and convex geom.
pub fn height_field(
    _m: &Model,
    _kin: &Kinematics,
    _g1: usize,
    _g2: usize,
    _margin: f64,
    _scratch: &mut ConvexScratch,
    _out: &mut Vec<PreContact>,
) {
}
