//! Facets without a proper boundary that wait to be united with others.

use std::collections::VecDeque;

use super::id::{FacetId, Marks};

/// Facets that unions have left without a proper boundary: covered ones, all of whose corners a neighbour
/// has, are dealt with before thin ones, which have fewer than three neighbours.
#[derive(Debug, Default)]
pub(super) struct Slivers {
    /// Each with the facet that has its corners; the latest first.
    covered: Vec<(FacetId, FacetId)>,
    /// The back first.
    thin: VecDeque<FacetId>,
    is_covered: Marks<FacetId>,
    is_thin: Marks<FacetId>,
}

pub(super) enum Sliver {
    Covered { facet: FacetId, by: FacetId },
    Thin(FacetId),
}

impl Slivers {
    pub(super) fn add_covered(&mut self, facet: FacetId, by: FacetId) {
        if !self.is_covered.has(by) && self.is_covered.add(facet) {
            self.covered.push((facet, by));
        }
    }

    pub(super) fn add_thin(&mut self, facet: FacetId) {
        if self.is_covered.has(facet) || !self.is_thin.add(facet) {
            return;
        }
        // While covered facets wait, a thin one goes behind those found before.
        if self.covered.is_empty() {
            self.thin.push_back(facet);
        } else {
            self.thin.push_front(facet);
        }
    }

    pub(super) fn has(&self, facet: FacetId) -> bool {
        self.is_covered.has(facet) || self.is_thin.has(facet)
    }

    pub(super) fn next(&mut self) -> Option<Sliver> {
        let covered = self.covered.pop().map(|(facet, by)| (facet, Sliver::Covered { facet, by }));
        let next = covered.or_else(|| self.thin.pop_back().map(|facet| (facet, Sliver::Thin(facet))));
        let (facet, sliver) = next?;
        self.is_covered.remove(facet);
        self.is_thin.remove(facet);
        Some(sliver)
    }
}
