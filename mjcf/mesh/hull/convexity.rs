//! Convexity of neighbouring facets by their centres, and the loop that merges until it holds.

use super::Failure;
use super::merge::{Merge, Reason};
use super::polytope::{Polytope, TAIL};

impl Polytope<'_> {
    /// Whether all new facets are triangles on triangles, clearly convex to all neighbours.
    pub(super) fn new_facets_are_convex(&mut self) -> bool {
        let new = self.facets_from(self.first_new);
        let plain = |f: usize| {
            let facet = &self.facets[f];
            self.facets[facet.neighbors[0]].simplicial && !facet.flipped && facet.normal.is_some()
        };
        if !new.iter().all(|&f| plain(f)) {
            return false;
        }
        let limit = -2.0 * self.tol.round;
        new.iter().all(|&f| {
            let facet = &self.facets[f];
            let base = [facet.vertices[1], facet.vertices[2]];
            let sides_convex =
                (1..3).all(|k| self.distance(self.point(facet.vertices[k]), facet.neighbors[k]) < limit);
            let beyond = self.facets[facet.neighbors[0]].vertices.iter().find(|v| !base.contains(v));
            sides_convex && beyond.is_none_or(|&v| self.distance(self.point(v), f) < limit)
        })
    }

    /// Mean of the vertices, projected onto the plane.
    pub(super) fn center_of(&mut self, facet: usize) -> [f64; 3] {
        if let Some(center) = self.facets[facet].center {
            return center;
        }
        let vertices = &self.facets[facet].vertices;
        let mut mean = [0.0; 3];
        for (axis, x) in mean.iter_mut().enumerate() {
            for &v in vertices {
                *x += self.point(v)[axis];
            }
            *x /= vertices.len() as f64;
        }
        let height = self.distance(mean, facet);
        let n = self.facets[facet].normal.unwrap_or_default();
        let center = std::array::from_fn(|k| mean[k] - height * n[k]);
        self.facets[facet].center = Some(center);
        center
    }

    /// Queues a merge if two neighbours are not clearly convex; whether it did.
    fn queue_if_nonconvex(&mut self, facet: usize, neighbor: usize) -> bool {
        let limit = self.tol.center;
        let centers = [self.center_of(facet), self.center_of(neighbor)];
        let above_neighbor = self.distance(centers[0], neighbor);
        let above_facet = self.distance(centers[1], facet);
        let concave = above_neighbor > limit || above_facet > limit;
        let within = |d: f64| d >= -limit && d <= limit;
        let coplanar = within(above_neighbor) || within(above_facet);
        match (concave, coplanar) {
            (false, false) => return false,
            (true, true) if above_neighbor > above_facet => {
                self.queue(facet, neighbor, Reason::ConcaveCoplanar, above_neighbor);
            }
            (true, true) => self.queue(neighbor, facet, Reason::ConcaveCoplanar, above_facet),
            (true, false) => {
                self.queue(facet, neighbor, Reason::Concave, above_neighbor.max(above_facet));
            }
            (false, true) => {
                let nearer = above_neighbor.abs().min(above_facet.abs());
                self.queue(facet, neighbor, Reason::Coplanar, nearer);
            }
        }
        true
    }

    /// Tests each pair of neighbours among and around the new facets once.
    pub(super) fn queue_all_nonconvex(&mut self) {
        self.visit += 1;
        let visit = self.visit;
        for f in self.facets_from(self.first_new) {
            self.facets[f].visit = visit;
            for n in self.facets[f].neighbors.clone() {
                if self.facets[n].visit == visit || !self.queue_if_nonconvex(f, n) {
                    continue;
                }
                let ridges = &self.facets[n].ridges;
                if let Some(&r) = ridges.iter().find(|&&r| self.ridges[r].other(n) == f) {
                    self.ridges[r].nonconvex = true;
                }
            }
            self.facets[f].tested = true;
            for k in 0..self.facets[f].ridges.len() {
                let r = self.facets[f].ridges[k];
                self.ridges[r].tested = true;
            }
        }
        self.sort_merges();
    }

    /// Tests the ridges that merging has changed.
    pub(super) fn queue_changed_nonconvex(&mut self) {
        self.visit += 1;
        let visit = self.visit;
        for f in self.facets_from(self.first_new) {
            if self.facets[f].tested {
                continue;
            }
            self.facets[f].visit = visit;
            for k in 0..self.facets[f].neighbors.len() {
                let n = self.facets[f].neighbors[k];
                self.facets[n].seen = false;
            }
            for r in self.facets[f].ridges.clone() {
                if self.ridges[r].tested && !self.ridges[r].nonconvex {
                    continue;
                }
                let n = self.ridges[r].other(f);
                if self.facets[n].seen {
                    self.ridges[r].tested = true;
                    self.ridges[r].nonconvex = false;
                } else if self.facets[n].visit != visit {
                    self.facets[n].seen = true;
                    let nonconvex = self.queue_if_nonconvex(f, n);
                    self.ridges[r].nonconvex = nonconvex;
                    self.ridges[r].tested = true;
                }
            }
            self.facets[f].tested = true;
        }
        self.sort_merges();
    }

    /// The next merge, the one that bends the hull least, comes last.
    fn sort_merges(&mut self) {
        self.merges.sort_by(|a, b| b.reason.cmp(&a.reason).then(b.distance.total_cmp(&a.distance)));
    }

    /// Merges queued facets until all are convex; `merged` tells of merges before.
    pub(super) fn merge_all(&mut self, mut merged: bool) -> Result<(), Failure> {
        loop {
            while !self.merges.is_empty() || !self.degenerate_merges.is_empty() {
                if !self.degenerate_merges.is_empty() {
                    self.merge_degenerate()?;
                    merged = true;
                }
                while let Some(Merge { reason, first, second, .. }) = self.merges.pop() {
                    if self.facets[first].visible || self.facets[second].visible {
                        continue;
                    }
                    let changed = |f: usize| !self.facets[f].tested && self.facets[f].new;
                    if reason == Reason::Coplanar && (changed(first) || changed(second)) {
                        continue;
                    }
                    self.merge_nonconvex(first, second, reason)?;
                    self.merge_degenerate()?;
                    merged = true;
                }
                self.queue_changed_nonconvex();
            }
            if !(self.has_vertex_neighbors && merged) {
                return Ok(());
            }
            merged = false;
            if !self.reduce_vertices()? {
                return Ok(());
            }
            self.queue_changed_nonconvex();
        }
    }

    /// Queues neighbours whose vertices are all vertices of `facet`.
    pub(super) fn queue_redundant_neighbors(&mut self, facet: usize) {
        if self.facets[facet].neighbors.len() < 3 {
            self.queue(facet, facet, Reason::Degenerate, 0.0);
            return;
        }
        let own = self.visit_vertices(facet);
        for n in self.facets[facet].neighbors.clone() {
            let neighbor = &self.facets[n];
            if neighbor.degenerate || neighbor.redundant || (self.facets[facet].flipped && !neighbor.flipped)
            {
                continue;
            }
            if neighbor.vertices.iter().all(|&v| self.vertices[v].visit == own) {
                self.queue(n, facet, Reason::Redundant, 0.0);
            }
        }
    }

    /// Queues neighbours of `facet` with fewer than three neighbours.
    pub(super) fn queue_degenerate_neighbors(&mut self, facet: usize) {
        for n in self.facets[facet].neighbors.clone() {
            let neighbor = &self.facets[n];
            if !neighbor.degenerate && !neighbor.redundant && neighbor.neighbors.len() < 3 {
                self.queue(n, n, Reason::Degenerate, 0.0);
            }
        }
    }

    /// Queues `facet` if a neighbour has all its vertices, or if it has fewer than three neighbours.
    pub(super) fn queue_if_degenerate_or_redundant(&mut self, facet: usize) {
        if self.facets[facet].flipped {
            return;
        }
        for n in self.facets[facet].neighbors.clone() {
            if self.facets[n].flipped || n == TAIL {
                continue;
            }
            let theirs = self.visit_vertices(n);
            if self.facets[facet].vertices.iter().all(|&v| self.vertices[v].visit == theirs) {
                self.queue(facet, n, Reason::Redundant, 0.0);
                return;
            }
        }
        if self.facets[facet].neighbors.len() < 3 {
            self.queue(facet, facet, Reason::Degenerate, 0.0);
        }
    }
}
