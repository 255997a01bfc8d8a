//! What the parts of a flexcomp hand to each other: points and elements.

use crate::flex::Cloud;

/// Points of a flexcomp in the parent body, and which of them are fixed to it.
pub(super) struct Points {
    pub(super) cloud: Cloud,
    /// Least and greatest coordinates.
    pub(super) bounds: [[f64; 3]; 2],
    /// By point, and by node of the lattice where there is one.
    pub(super) pinned: Vec<bool>,
    /// All points are fixed.
    pub(super) rigid: bool,
    /// No point is fixed.
    pub(super) free: bool,
}
