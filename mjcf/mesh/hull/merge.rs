//! Merging one facet into another, and the queues of merges to do.

use super::Failure;
use super::polytope::{NONE, Polytope, remove_ordered, remove_unordered, replace_item};

/// Why two facets are merged; later kinds are more urgent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reason {
    /// The centre of one is within round-off of the other's plane.
    Coplanar,
    /// The centre of one is above the other.
    Concave,
    /// One of each.
    ConcaveCoplanar,
    /// A facet faces the interior.
    Flipped,
    /// A facet has fewer than three neighbours.
    Degenerate,
    /// All vertices of a facet are a neighbour's.
    Redundant,
    /// A new facet lies in the plane of its horizon facet.
    CoplanarHorizon,
}

/// A merge to be done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Merge {
    pub reason: Reason,
    pub first: usize,
    pub second: usize,
    pub distance: f64,
}

/// Facets with more vertices than this are compared by their centres.
const MANY_VERTICES: usize = 2 * 3 + 20;
/// Facets with more vertices than this prefer neighbours over a nonconvex ridge.
const SOME_VERTICES: usize = 3 + 15;
/// Facets with more vertices than this keep their centre.
const KEEP_CENTER_VERTICES: usize = 3 + 5;

/// Range of the distances a merge causes: below and above the plane.
pub(super) type Range = (f64, f64);

impl Polytope<'_> {
    /// Merges new facets until the hull is convex within round-off.
    pub(super) fn merge_new(&mut self) -> Result<(), Failure> {
        if self.new_facets_are_convex() {
            return Ok(());
        }
        let mut merged = self.merge_cycles()?;
        merged |= self.merge_flipped()?;
        self.queue_all_nonconvex();
        self.merge_all(merged)
    }

    /// Queues a merge, unless a facet is about to disappear anyway.
    pub(super) fn queue(&mut self, first: usize, second: usize, reason: Reason, distance: f64) {
        if self.facets[first].redundant || self.facets[second].redundant {
            return;
        }
        let merge = Merge { reason, first, second, distance };
        match reason {
            Reason::Degenerate if self.facets[first].degenerate => {}
            Reason::Degenerate => {
                self.facets[first].degenerate = true;
                match self.degenerate_merges.last() {
                    Some(last) if last.reason != Reason::Degenerate => {
                        self.degenerate_merges.insert(0, merge)
                    }
                    _ => self.degenerate_merges.push(merge),
                }
            }
            Reason::Redundant => {
                self.facets[first].redundant = true;
                self.degenerate_merges.push(merge);
            }
            _ => self.merges.push(merge),
        }
    }

    /// Works off the queue of degenerate and redundant facets; how many were removed.
    pub(super) fn merge_degenerate(&mut self) -> Result<usize, Failure> {
        let mut count = 0;
        while let Some(Merge { reason, first, second, .. }) = self.degenerate_merges.pop() {
            if self.facets[first].visible {
                continue;
            }
            self.facets[first].degenerate = false;
            self.facets[first].redundant = false;
            if reason == Reason::Redundant {
                let target = self.replacement(second);
                if target == NONE {
                    return Err(Failure("a redundant facet has lost its neighbour"));
                }
                if target == first {
                    continue;
                }
                self.merge_facet(first, target, reason, None)?;
                count += 1;
            } else if self.facets[first].neighbors.is_empty() {
                self.will_delete(first, NONE);
                for v in self.facets[first].vertices.clone() {
                    remove_unordered(&mut self.vertices[v].neighbors, first);
                    if self.vertices[v].neighbors.is_empty() {
                        self.mark_deleted(v);
                    }
                }
                count += 1;
            } else if self.facets[first].neighbors.len() < 3 {
                let (best, _, range) = self.best_neighbor(first)?;
                self.merge_facet(first, best, reason, Some(range))?;
                count += 1;
            }
        }
        Ok(count)
    }

    /// Merges facets that face the interior into their best neighbours.
    fn merge_flipped(&mut self) -> Result<bool, Failure> {
        let mut merged = false;
        for f in self.facets_from(self.first_new) {
            if !self.facets[f].flipped || self.facets[f].visible {
                continue;
            }
            let (best, _, range) = self.best_neighbor(f)?;
            self.merge_facet(f, best, Reason::Flipped, Some(range))?;
            merged = true;
        }
        self.merge_degenerate()?;
        Ok(merged)
    }

    /// Merges two facets that are not convex to each other, one of them into its best neighbour.
    pub(super) fn merge_nonconvex(
        &mut self,
        first: usize,
        second: usize,
        reason: Reason,
    ) -> Result<(), Failure> {
        let (a, b) = if self.facets[first].new { (first, second) } else { (second, first) };
        let (best_a, distance_a, range_a) = self.best_neighbor(a)?;
        let (best_b, distance_b, range_b) = self.best_neighbor(b)?;
        if distance_a < distance_b {
            self.merge_facet(a, best_a, reason, Some(range_a))
        } else {
            self.merge_facet(b, best_b, reason, Some(range_b))
        }
    }

    /// The neighbour whose plane is nearest to the vertices of `facet`, how far that is, and the range.
    pub(super) fn best_neighbor(&mut self, facet: usize) -> Result<(usize, f64, Range), Failure> {
        let size = self.facets[facet].vertices.len();
        let by_center = size > MANY_VERTICES;
        if by_center {
            self.center_of(facet);
        }
        let mut best = (NONE, f64::MAX, (0.0, 0.0));
        if size > SOME_VERTICES {
            for k in 0..self.facets[facet].ridges.len() {
                let ridge = self.ridges[self.facets[facet].ridges[k]];
                if ridge.nonconvex {
                    self.try_neighbor(facet, ridge.other(facet), by_center, &mut best);
                }
            }
        }
        if best.0 == NONE {
            for k in 0..self.facets[facet].neighbors.len() {
                self.try_neighbor(facet, self.facets[facet].neighbors[k], by_center, &mut best);
            }
        }
        if best.0 == NONE {
            return Err(Failure("a facet has no neighbour to merge with"));
        }
        if by_center {
            best.2 = self.vertex_range(facet, best.0).1;
        }
        Ok(best)
    }

    fn try_neighbor(
        &mut self,
        facet: usize,
        neighbor: usize,
        by_center: bool,
        best: &mut (usize, f64, Range),
    ) {
        if self.facets[facet].flipped
            && self.facets[neighbor].flipped
            && best.0 != NONE
            && !self.facets[best.0].flipped
        {
            return;
        }
        let (distance, range) = if by_center {
            let height = 3.0 * self.distance(self.facets[facet].center.unwrap_or_default(), neighbor);
            (height.abs(), (height.min(0.0), height.max(0.0)))
        } else {
            self.vertex_range(facet, neighbor)
        };
        if distance < best.1 {
            *best = (neighbor, distance, range);
        }
    }

    /// Largest distance, and its range, of the vertices of `facet` from the plane of `neighbor`.
    fn vertex_range(&mut self, facet: usize, neighbor: usize) -> (f64, Range) {
        let shared = self.visit_vertices(neighbor);
        let (mut below, mut above) = (0.0, 0.0);
        for &v in &self.facets[facet].vertices {
            if self.vertices[v].visit == shared {
                continue;
            }
            let distance = self.distance(self.point(v), neighbor);
            if distance < below {
                below = distance;
            } else if distance > above {
                above = distance;
            }
        }
        (above.max(-below), (below, above))
    }

    /// Merges `from` into `into`. `range` says how far the vertices are from the plane; a facet that is
    /// coplanar with its horizon contributes its apex.
    pub(super) fn merge_facet(
        &mut self,
        from: usize,
        into: usize,
        reason: Reason,
        range: Option<Range>,
    ) -> Result<(), Failure> {
        self.merge_count += 1;
        if from == into || self.facets[from].visible || self.facets[into].visible {
            return Err(Failure("a facet was merged twice"));
        }
        if self.facet_count - self.visible_count <= 4 {
            return Err(Failure("merging leaves too few facets"));
        }
        self.ensure_vertex_neighbors();
        self.make_ridges(from);
        self.make_ridges(into);
        if let Some((below, above)) = range {
            self.max_outside = self.max_outside.max(above);
            if above > self.tol.wide || below < -self.tol.wide {
                self.facets[into].keep_center = true;
            }
        }
        self.facets[into].new_merge = true;
        self.forget_tests(from, into);
        if self.facets[from].vertices.len() == 3 {
            self.merge_triangle(from, into, reason == Reason::CoplanarHorizon)?;
        } else {
            let own = self.visit_vertices(into);
            self.merge_neighbors(from, into)?;
            self.merge_vertices(from, into);
            self.merge_ridges(from, into);
            for v in self.facets[from].vertices.clone() {
                if self.vertices[v].visit == own {
                    self.drop_vertex_neighbor(v, from, into);
                } else {
                    replace_item(&mut self.vertices[v].neighbors, from, into)?;
                }
            }
            if !self.facets[into].new {
                self.renew_vertices(into);
            }
        }
        self.requeue(into);
        self.facets[into].new = true;
        self.facets[into].tested = false;
        if reason != Reason::CoplanarHorizon {
            self.queue_redundant_neighbors(into);
            self.queue_degenerate_neighbors(from);
            self.queue_if_degenerate_or_redundant(into);
        }
        self.will_delete(from, into);
        Ok(())
    }

    /// Convexity has to be tested again around a merged facet.
    fn forget_tests(&mut self, from: usize, into: usize) {
        self.facets[into].tested = false;
        for k in 0..self.facets[from].ridges.len() {
            let r = self.facets[from].ridges[k];
            self.ridges[r].tested = false;
        }
        let facet = &mut self.facets[into];
        if facet.center.is_none() {
            return;
        }
        let size = facet.vertices.len();
        if !facet.keep_center {
            facet.keep_center = size > KEEP_CENTER_VERTICES;
        } else if size == 3 {
            facet.keep_center = false;
        }
        if !facet.keep_center {
            facet.center = None;
            for k in 0..self.facets[into].ridges.len() {
                let r = self.facets[into].ridges[k];
                self.ridges[r].tested = false;
            }
        }
    }

    /// Removes a facet from around a vertex; without a second facet the vertex is no longer one.
    fn drop_vertex_neighbor(&mut self, vertex: usize, from: usize, into: usize) {
        remove_unordered(&mut self.vertices[vertex].neighbors, from);
        if self.vertices[vertex].neighbors.len() < 2 {
            remove_ordered(&mut self.facets[into].vertices, vertex);
            self.mark_deleted(vertex);
        }
    }

    /// Merge of a triangle: it adds at most the vertex opposite the shared ridge.
    fn merge_triangle(&mut self, from: usize, into: usize, apex: bool) -> Result<(), Failure> {
        let corners: Vec<usize> = self.facets[from].vertices.clone();
        let (opposite, is_new);
        if apex {
            opposite = corners[0];
            if !self.facets[into].new {
                self.renew_vertices(into);
            }
            is_new = self.facets[into].vertices[0] != opposite;
            if is_new {
                self.facets[into].vertices.insert(0, opposite);
            }
        } else {
            let ridges = &self.facets[from].ridges;
            let shared = ridges.iter().map(|&r| self.ridges[r]).find(|ridge| ridge.other(from) == into);
            let shared = shared.map_or([NONE; 2], |ridge| ridge.vertices);
            for v in shared.into_iter().filter(|&v| v != NONE) {
                self.vertices[v].lost_ridge = true;
            }
            opposite = corners.iter().copied().find(|v| !shared.contains(v)).unwrap_or(corners[0]);
            is_new = self.add_vertex_to_facet(into, opposite);
            if !self.facets[into].new {
                self.renew_vertices(into);
            } else if !self.vertices[opposite].new {
                self.remove_vertex(opposite);
                self.append_vertex(opposite);
            }
        }
        for &v in &corners {
            if v == opposite && is_new {
                replace_item(&mut self.vertices[v].neighbors, from, into)?;
            } else {
                self.drop_vertex_neighbor(v, from, into);
            }
        }
        self.visit += 1;
        let visit = self.visit;
        for k in 0..self.facets[into].neighbors.len() {
            let n = self.facets[into].neighbors[k];
            self.facets[n].visit = visit;
        }
        let mut k = 0;
        while k < self.facets[from].ridges.len() {
            let r = self.facets[from].ridges[k];
            let other = self.ridges[r].other(from);
            if other == into {
                self.delete_ridge(r);
                remove_unordered(&mut self.facets[into].neighbors, from);
                continue;
            }
            self.facets[into].ridges.push(r);
            if self.facets[other].visit != visit {
                self.facets[into].neighbors.push(other);
                replace_item(&mut self.facets[other].neighbors, from, into)?;
                self.facets[other].visit = visit;
            } else {
                self.make_ridges(other);
                let list = &mut self.facets[other].neighbors;
                if list.first() == Some(&from) {
                    remove_unordered(list, into);
                    replace_item(list, from, into)?;
                } else {
                    remove_unordered(list, from);
                }
            }
            self.hand_over_ridge(r, from, into);
            k += 1;
        }
        Ok(())
    }

    fn hand_over_ridge(&mut self, ridge: usize, from: usize, into: usize) {
        let ridge = &mut self.ridges[ridge];
        if ridge.top == from {
            ridge.top = into;
            ridge.simplicial_top = false;
        } else {
            ridge.bottom = into;
            ridge.simplicial_bottom = false;
        }
    }

    fn merge_neighbors(&mut self, from: usize, into: usize) -> Result<(), Failure> {
        self.visit += 1;
        let visit = self.visit;
        for k in 0..self.facets[into].neighbors.len() {
            let n = self.facets[into].neighbors[k];
            self.facets[n].visit = visit;
        }
        for n in self.facets[from].neighbors.clone() {
            if self.facets[n].visit == visit {
                self.make_ridges(n);
                let list = &mut self.facets[n].neighbors;
                if list.first() == Some(&from) {
                    remove_unordered(list, into);
                    replace_item(list, from, into)?;
                } else {
                    remove_unordered(list, from);
                }
            } else if n != into {
                self.facets[into].neighbors.push(n);
                replace_item(&mut self.facets[n].neighbors, from, into)?;
            }
        }
        remove_unordered(&mut self.facets[from].neighbors, into);
        remove_unordered(&mut self.facets[into].neighbors, from);
        Ok(())
    }

    /// Union of the vertices in decreasing order.
    fn merge_vertices(&mut self, from: usize, into: usize) {
        let mut union = self.facets[from].vertices.clone();
        union.extend(&self.facets[into].vertices);
        union.sort_unstable_by(|a, b| b.cmp(a));
        union.dedup();
        self.facets[into].vertices = union;
    }

    fn merge_ridges(&mut self, from: usize, into: usize) {
        let mut k = 0;
        while k < self.facets[into].ridges.len() {
            let r = self.facets[into].ridges[k];
            if self.ridges[r].top == from || self.ridges[r].bottom == from {
                self.delete_ridge(r);
            } else {
                k += 1;
            }
        }
        for r in self.facets[from].ridges.clone() {
            self.hand_over_ridge(r, from, into);
            self.facets[into].ridges.push(r);
        }
    }

    /// Removes a ridge; another ridge between the same facets inherits that it is not convex.
    pub(super) fn delete_ridge(&mut self, id: usize) {
        let ridge = self.ridges[id];
        if ridge.nonconvex {
            self.pass_on_nonconvexity(id);
        }
        for v in ridge.vertices {
            self.vertices[v].lost_ridge = true;
        }
        remove_unordered(&mut self.facets[ridge.top].ridges, id);
        remove_unordered(&mut self.facets[ridge.bottom].ridges, id);
    }

    fn pass_on_nonconvexity(&mut self, id: usize) {
        let Some(ridge) = self.ridges.get_mut(id) else { return };
        ridge.nonconvex = false;
        let (facet, other) = (ridge.top, ridge.bottom);
        for k in 0..self.facets[facet].ridges.len() {
            let r = self.facets[facet].ridges[k];
            if r != id && (self.ridges[r].top == other || self.ridges[r].bottom == other) {
                self.ridges[r].nonconvex = true;
                break;
            }
        }
    }

    /// Inserts a vertex in decreasing order; whether it was not there yet.
    fn add_vertex_to_facet(&mut self, facet: usize, vertex: usize) -> bool {
        let list = &mut self.facets[facet].vertices;
        let at = list.iter().position(|&v| v <= vertex).unwrap_or(list.len());
        if list.get(at) == Some(&vertex) {
            return false;
        }
        list.insert(at, vertex);
        true
    }
}
