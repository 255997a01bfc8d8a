//! Which pairs of geoms may touch, of those that no predefined pair and no exclusion names.

use crate::collision::broad_phase::types_match;
use crate::model::Model;

/// Decides about two geoms whose bodies may touch.
pub trait PairFilter {
    /// Whether geoms `g1` and `g2`, the first of the lower type, are to be looked at; those that are `named` by a
    /// predefined pair are not.
    fn admits(&mut self, m: &Model, g1: usize, g2: usize, named: impl FnOnce() -> bool) -> bool;
}

/// The contact types of both geoms (documentation: Computation, "Collision detection", selection).
#[derive(Clone, Copy, Debug)]
pub struct ByType;

impl PairFilter for ByType {
    #[inline(always)]
    fn admits(&mut self, m: &Model, g1: usize, g2: usize, named: impl FnOnce() -> bool) -> bool {
        let (t1, a1) = (m.geom_contype[g1], m.geom_conaffinity[g1]);
        let (t2, a2) = (m.geom_contype[g2], m.geom_conaffinity[g2]);
        types_match(t1, a1, t2, a2) && !named()
    }
}

/// What a program decides, in place of contact types.
#[derive(Debug)]
pub struct Decided<F>(pub F);

impl<F: FnMut(usize, usize) -> bool> PairFilter for Decided<F> {
    fn admits(&mut self, _: &Model, g1: usize, g2: usize, named: impl FnOnce() -> bool) -> bool {
        !named() && (self.0)(g1, g2)
    }
}
