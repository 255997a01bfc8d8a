//! The hull while it grows.

use super::id::{FacetId, Marks};
use super::slivers::Slivers;
use super::surface::Surface;
use super::tolerance::{Slack, Tolerances};

/// The hull while it grows: the surface, and what decides where it lies.
pub(super) struct Builder<'a> {
    pub(super) points: &'a [[f64; 3]],
    pub(super) tol: Tolerances,
    pub(super) slack: Slack,
    /// A point inside the first tetrahedron, and so inside every later hull.
    pub(super) interior: [f64; 3],
    /// The first tetrahedron is so flat that points near a facet count as above it.
    pub(super) narrow: bool,
    pub(super) surface: Surface,
    pub(super) search: Search,
    pub(super) slivers: Slivers,
    /// Facets united with others since their corners were last examined.
    pub(super) grown: Marks<FacetId>,
}

/// How the current step searches.
#[derive(Debug, Default)]
pub(super) struct Search {
    /// Compare all fresh facets instead of walking.
    pub sweep: bool,
    /// The fresh facets have been found to face one octant.
    pub blunt: bool,
    pub pending: Vec<FacetId>,
}

impl Builder<'_> {
    /// Height of a point above the plane of a facet.
    pub(super) fn height(&self, point: [f64; 3], facet: FacetId) -> f64 {
        self.surface.facets[facet].plane.height(point)
    }
}
