//! Vertices inside an edge: unions leave vertices between two facets only. Such a vertex disappears, and the
//! two ridges at it become one.

use super::id::{FacetId, RidgeId, VertexId};
use super::surface::{Surface, take_out};

impl Surface {
    /// Dissolves the loose vertices of a facet that have only one other facet. Returns the facets that lost
    /// a corner.
    pub(super) fn dissolve_corners(&mut self, facet: FacetId) -> Vec<FacetId> {
        let mut changed = Vec::new();
        let mut k = 0;
        while let Some(&vertex) = self.facets[facet].corners.get(k) {
            let pair: Option<[FacetId; 2]> = self.vertices[vertex].around.as_slice().try_into().ok();
            match pair.filter(|_| self.vertices[vertex].loose) {
                Some([a, b]) if self.dissolve(vertex, facet, a, b) => changed.extend([a, b]),
                _ => k += 1,
            }
        }
        changed
    }

    /// Removes a vertex between the facets `a` and `b`, one of them `facet`; false if it has to stay.
    fn dissolve(&mut self, vertex: VertexId, facet: FacetId, a: FacetId, b: FacetId) -> bool {
        let other = if a == facet { b } else { a };
        let at_vertex = |&&id: &&RidgeId| {
            let ridge = &self.ridges[id];
            ridge.borders(other) && ridge.ends.contains(&vertex)
        };
        let ridges: Vec<RidgeId> = self.facets[facet].ridges.iter().filter(at_vertex).copied().collect();
        let Some(stays) = self.surviving_end(vertex, facet, other, &ridges) else { return false };
        for ridge in ridges {
            self.shift_end(ridge, vertex, stays);
        }
        for facet in [a, b] {
            self.facets[facet].corners.retain(|&corner| corner != vertex);
        }
        self.lose_vertex(vertex);
        true
    }

    /// Towards which end of its ridges a vertex is shifted: the first common corner of the two facets, after
    /// striking out the vertex and those off the ridges, each replaced by the last in the list. Either end
    /// would do, but this decides which ridge stays in the lists, and so the order of later triangles.
    fn surviving_end(
        &self,
        vertex: VertexId,
        facet: FacetId,
        other: FacetId,
        ridges: &[RidgeId],
    ) -> Option<VertexId> {
        let ends = |corner: VertexId| ridges.iter().any(|&ridge| self.ridges[ridge].ends.contains(&corner));
        let theirs = &self.facets[other].corners;
        let common = self.facets[facet].corners.iter().copied();
        let mut common: Vec<VertexId> = common.filter(|corner| theirs.contains(corner)).collect();
        take_out(&mut common, vertex);
        while let Some(&first) = common.first() {
            if ends(first) {
                return Some(first);
            }
            common.swap_remove(0);
        }
        None
    }

    /// Moves the end of a ridge from one vertex to another; a ridge that shrinks to a point is deleted.
    fn shift_end(&mut self, id: RidgeId, from: VertexId, to: VertexId) {
        let ridge = &mut self.ridges[id];
        let stays = if ridge.ends[0] == from { ridge.ends[1] } else { ridge.ends[0] };
        if stays == to {
            self.delete_ridge(id);
            return;
        }
        // The right side is the right of someone who walks from the newer end.
        if (from > stays) != (to > stays) {
            ridge.sides.reverse();
        }
        ridge.ends = if to > stays { [to, stays] } else { [stays, to] };
    }

    /// Forgets which fresh vertices were loose.
    pub(super) fn tighten(&mut self) {
        for vertex in self.vertex_order.fresh() {
            if !self.vertices[vertex].phase.is_removed() {
                self.vertices[vertex].loose = false;
            }
        }
    }
}
