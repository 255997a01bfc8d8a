//! Contacts between convex geoms.

use super::PreContact;
use crate::data::Kinematics;
use crate::model::Model;

/// Working memory of the convex algorithms, reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct ConvexScratch {}

/// Contacts of convex geoms `g1` and `g2` (documentation: Computation, "Convex collisions").
pub fn convex(
    _m: &Model,
    _kin: &Kinematics,
    _g1: usize,
    _g2: usize,
    _margin: f64,
    _scratch: &mut ConvexScratch,
    _out: &mut Vec<PreContact>,
) {
}
