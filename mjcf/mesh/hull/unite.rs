//! The union of two neighbouring facets: one takes over the borders and the corners of the other.
//!
//! Which facet a search or the next horizon meets first depends on the order of these lists. A triangle is
//! taken ridge by ridge; a polygon's neighbours are taken first, then its ridges.

use super::failure::Failure;
use super::id::{FacetId, RidgeId, VertexId};
use super::surface::{Convexity, Phase, Ridge, Surface, replace, take_out};

/// The centre of a facet with more corners than this hardly moves.
const STEADY_CENTER: usize = 3 + 5;

impl Surface {
    /// Unites `from` with its neighbour `into`, which becomes fresh and untested.
    pub(super) fn unite(&mut self, from: FacetId, into: FacetId) -> Result<(), Failure> {
        self.keep_around();
        self.become_polygon(from);
        self.become_polygon(into);
        self.forget_tests(from, into);
        let triangle = self.facets[from].corners.len() == 3;
        // The corner that a triangle adds.
        let tip = if triangle { self.tip(from, into) } else { None };
        if triangle {
            self.take_triangle_borders(from, into)?;
        } else {
            self.take_polygon_borders(from, into)?;
        }
        self.take_corners(from, into)?;
        if self.facets[into].phase == Phase::Settled {
            for k in 0..self.facets[into].corners.len() {
                self.freshen_vertex(self.facets[into].corners[k]);
            }
        } else if let Some(tip) = tip {
            self.freshen_vertex(tip);
        }
        self.freshen_facet(into);
        self.facets[into].tested = false;
        self.retire(from, into);
        Ok(())
    }

    /// Convexity has to be tested again where a union changes a facet, and all around it if its centre moves.
    fn forget_tests(&mut self, from: FacetId, into: FacetId) {
        let Self { facets, ridges, .. } = self;
        let mut forget = |list: &[RidgeId]| {
            for &ridge in list {
                if ridges[ridge].convexity == Convexity::Convex {
                    ridges[ridge].convexity = Convexity::Unknown;
                }
            }
        };
        forget(&facets[from].ridges);
        let facet = &mut facets[into];
        if facet.center.is_none() {
            return;
        }
        let corners = facet.corners.len();
        facet.pinned = if facet.pinned { corners != 3 } else { corners > STEADY_CENTER };
        if !facet.pinned {
            facet.center = None;
            forget(&facet.ridges);
        }
    }

    /// The corner of `from` off its first ridge towards `into`.
    fn tip(&self, from: FacetId, into: FacetId) -> Option<VertexId> {
        let facet = &self.facets[from];
        let seam = facet.ridges.iter().map(|&r| &self.ridges[r]).find(|ridge| ridge.borders(into))?;
        facet.corners.iter().copied().find(|corner| !seam.ends.contains(corner))
    }

    fn take_triangle_borders(&mut self, from: FacetId, into: FacetId) -> Result<(), Failure> {
        self.mark_neighbors(into);
        let mut k = 0;
        while let Some(&ridge) = self.facets[from].ridges.get(k) {
            let beyond = self.ridges[ridge].beyond(from);
            if beyond == into {
                self.delete_ridge(ridge);
                take_out(&mut self.facets[into].neighbors, from);
                continue;
            }
            self.facets[into].ridges.push(ridge);
            self.take_neighbor(beyond, from, into)?;
            self.ridges[ridge].hand_over(from, into);
            k += 1;
        }
        Ok(())
    }

    fn take_polygon_borders(&mut self, from: FacetId, into: FacetId) -> Result<(), Failure> {
        self.mark_neighbors(into);
        for k in 0..self.facets[from].neighbors.len() {
            let neighbor = self.facets[from].neighbors[k];
            if neighbor != into {
                self.take_neighbor(neighbor, from, into)?;
            }
        }
        take_out(&mut self.facets[into].neighbors, from);
        let mut k = 0;
        while let Some(&ridge) = self.facets[into].ridges.get(k) {
            if self.ridges[ridge].borders(from) {
                self.delete_ridge(ridge);
            } else {
                k += 1;
            }
        }
        for k in 0..self.facets[from].ridges.len() {
            let ridge = self.facets[from].ridges[k];
            self.ridges[ridge].hand_over(from, into);
            self.facets[into].ridges.push(ridge);
        }
        Ok(())
    }

    fn mark_neighbors(&mut self, facet: FacetId) {
        self.passed.clear();
        for &neighbor in &self.facets[facet].neighbors {
            self.passed.add(neighbor);
        }
    }

    /// Makes a neighbour of `from` one of `into`, whose other neighbours are marked. A neighbour of both has
    /// two borders with the union, which a triangle's list cannot tell, so it becomes a polygon.
    fn take_neighbor(&mut self, neighbor: FacetId, from: FacetId, into: FacetId) -> Result<(), Failure> {
        let is_shared = !self.passed.add(neighbor);
        if is_shared {
            self.become_polygon(neighbor);
            join_entries(&mut self.facets[neighbor].neighbors, from, into);
            Ok(())
        } else {
            self.facets[into].neighbors.push(neighbor);
            replace(&mut self.facets[neighbor].neighbors, from, into)
        }
    }

    /// Adds the corners of `from` to `into`. Corners of both lose a facet; one with a single facet left is
    /// inside the union.
    fn take_corners(&mut self, from: FacetId, into: FacetId) -> Result<(), Failure> {
        self.mark_corners(into);
        for k in 0..self.facets[from].corners.len() {
            let corner = self.facets[from].corners[k];
            let around = &mut self.vertices[corner].around;
            let corners = &mut self.facets[into].corners;
            if !self.own.has(corner) {
                replace(around, from, into)?;
                let at = corners.partition_point(|&other| other > corner);
                corners.insert(at, corner);
                continue;
            }
            take_out(around, from);
            if around.len() < 2 {
                corners.retain(|&other| other != corner);
                self.lose_vertex(corner);
            }
        }
        Ok(())
    }

    /// Deletes a ridge between two facets that have become one, or that meet at another ridge.
    pub(super) fn delete_ridge(&mut self, id: RidgeId) {
        let Ridge { ends, sides, convexity } = self.ridges[id];
        if convexity == Convexity::Nonconvex {
            // The two facets are as little convex at another ridge between them.
            let [right, left] = sides;
            let mut others = self.facets[right].ridges.iter().filter(|&&other| other != id);
            if let Some(&other) = others.find(|&&other| self.ridges[other].borders(left)) {
                self.ridges[other].convexity = Convexity::Nonconvex;
            }
        }
        for facet in sides {
            take_out(&mut self.facets[facet].ridges, id);
        }
        for vertex in ends {
            self.vertices[vertex].loose = true;
        }
    }
}

/// Makes the entries of two united facets one: that of `into`, in the first place if either had it. The order of the rest
/// changes as in [`take_out`].
fn join_entries(list: &mut Vec<FacetId>, from: FacetId, into: FacetId) {
    if list.first() == Some(&from)
        && let Some(at) = list.iter().position(|&entry| entry == into)
    {
        list.swap(0, at);
    }
    take_out(list, from);
}
