//! Whether neighbouring facets are clearly convex to each other.

use super::builder::Builder;
use super::id::{FacetId, Marks, VertexId};
use super::surface::Convexity;

/// How two facets fail to be clearly convex; unions of earlier kinds are less harmful.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BendKind {
    /// The centre of one is within round-off of the other's plane.
    Flat,
    /// The centre of one is above the other.
    Concave,
    /// One of each.
    Mixed,
}

/// Two neighbours that are not clearly convex to each other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    pub kind: BendKind,
    pub first: FacetId,
    pub second: FacetId,
    distance: f64,
}

/// Brings bends into the order in which they are straightened: least harmful kind, least distance, and of
/// equals the one found last.
fn ordered(mut bends: Vec<Bend>) -> Vec<Bend> {
    bends.reverse();
    bends.sort_by(|a, b| a.kind.cmp(&b.kind).then(a.distance.total_cmp(&b.distance)));
    bends
}

impl Builder<'_> {
    /// Whether all fresh facets are triangles on triangles that are clearly convex to all neighbours: the
    /// common case, settled without centres and ridges.
    pub(super) fn cone_is_convex(&self) -> bool {
        let facets = &self.surface.facets;
        let order = self.surface.agenda.order();
        let plain = |facet: FacetId| {
            !facets[facet].inverted && facets[facets[facet].neighbors[0]].shape.is_triangle()
        };
        if !order.fresh().all(plain) {
            return false;
        }
        let below = |corner: VertexId, facet: FacetId| {
            let point = self.points[self.surface.vertices[corner].point];
            self.height(point, facet) < -2.0 * self.tol.round
        };
        order.fresh().all(|triangle| {
            let facet = &facets[triangle];
            let base = &facet.corners[1..];
            let beyond = facets[facet.neighbors[0]].corners.iter().find(|corner| !base.contains(corner));
            (1..3).all(|k| below(facet.corners[k], facet.neighbors[k]))
                && beyond.is_none_or(|&corner| below(corner, triangle))
        })
    }

    /// Mean of the corners, projected onto the plane.
    pub(super) fn center_of(&mut self, facet: FacetId) -> [f64; 3] {
        let Self { points, surface, .. } = self;
        let facet = &mut surface.facets[facet];
        *facet.center.get_or_insert_with(|| {
            let mut mean = [0.0; 3];
            for &corner in &facet.corners {
                let point = points[surface.vertices[corner].point];
                mean = [0, 1, 2].map(|axis| mean[axis] + point[axis]);
            }
            facet.plane.project(mean.map(|sum| sum / facet.corners.len() as f64))
        })
    }

    /// How two neighbours fail to be clearly convex, judged by their centres.
    fn bend(&mut self, facet: FacetId, neighbor: FacetId) -> Option<Bend> {
        let limit = self.tol.center;
        let centers = [self.center_of(facet), self.center_of(neighbor)];
        let ours = self.height(centers[0], neighbor);
        let theirs = self.height(centers[1], facet);
        let concave = ours > limit || theirs > limit;
        let flat = ours.abs() <= limit || theirs.abs() <= limit;
        let (kind, distance) = match (concave, flat) {
            (false, false) => return None,
            (false, true) => (BendKind::Flat, ours.abs().min(theirs.abs())),
            (true, false) => (BendKind::Concave, ours.max(theirs)),
            (true, true) => (BendKind::Mixed, ours.max(theirs)),
        };
        let (first, second) = match kind {
            BendKind::Mixed if ours <= theirs => (neighbor, facet),
            _ => (facet, neighbor),
        };
        Some(Bend { kind, first, second, distance })
    }

    /// Bends between fresh facets and all their neighbours.
    pub(super) fn bends_of_fresh(&mut self) -> Vec<Bend> {
        let mut bends = Vec::new();
        let mut tested: Marks<FacetId> = Marks::default();
        let mut at = self.surface.agenda.order().first_fresh();
        while let Some(facet) = at {
            at = self.surface.agenda.order().after(facet);
            tested.add(facet);
            for k in 0..self.surface.facets[facet].neighbors.len() {
                let neighbor = self.surface.facets[facet].neighbors[k];
                if tested.has(neighbor) {
                    continue;
                }
                let Some(bend) = self.bend(facet, neighbor) else { continue };
                bends.push(bend);
                let surface = &mut self.surface;
                let ridges = &mut surface.ridges;
                let shared =
                    surface.facets[neighbor].ridges.iter().find(|&&ridge| ridges[ridge].borders(facet));
                if let Some(&ridge) = shared {
                    ridges[ridge].convexity = Convexity::Nonconvex;
                }
            }
            self.surface.facets[facet].tested = true;
            for &ridge in &self.surface.facets[facet].ridges {
                let convexity = &mut self.surface.ridges[ridge].convexity;
                if *convexity == Convexity::Unknown {
                    *convexity = Convexity::Convex;
                }
            }
        }
        ordered(bends)
    }

    /// Bends at the ridges of fresh facets that unions have changed.
    pub(super) fn bends_of_changed(&mut self) -> Vec<Bend> {
        let mut bends = Vec::new();
        let mut tested: Marks<FacetId> = Marks::default();
        let mut met: Marks<FacetId> = Marks::default();
        let mut at = self.surface.agenda.order().first_fresh();
        while let Some(facet) = at {
            at = self.surface.agenda.order().after(facet);
            if self.surface.facets[facet].tested {
                continue;
            }
            tested.add(facet);
            met.clear();
            for k in 0..self.surface.facets[facet].ridges.len() {
                let ridge = self.surface.facets[facet].ridges[k];
                let neighbor = self.surface.ridges[ridge].beyond(facet);
                if self.surface.ridges[ridge].convexity == Convexity::Convex {
                    continue;
                }
                // One ridge to a neighbour stands for all.
                let bend = match met.has(neighbor) {
                    true => None,
                    false if tested.has(neighbor) => continue,
                    false => self.bend(facet, neighbor),
                };
                met.add(neighbor);
                bends.extend(bend);
                self.surface.ridges[ridge].convexity =
                    if bend.is_some() { Convexity::Nonconvex } else { Convexity::Convex };
            }
            self.surface.facets[facet].tested = true;
        }
        ordered(bends)
    }
}
