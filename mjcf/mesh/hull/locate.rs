//! Which facet a point belongs to: the one it is highest above, found by walking and by searching new
//! facets; points above a facet wait in its outside set, points within round-off in its coplanar set.

use super::polytope::{NONE, Polytope, TAIL, push_before_last};

/// After this many merges, walking is no longer reliable.
const WALK_MERGES: usize = 50;
/// A coplanar point this many times farther out than allowed is an outside point.
const OUTSIDE_RATIO: f64 = 30.0;

/// Outcome of a search.
struct Best {
    facet: usize,
    distance: f64,
    outside: bool,
}

impl Polytope<'_> {
    /// Whether every new facet must be searched because merging bent the hull.
    pub(super) fn many_merges(&self) -> bool {
        self.merge_count > WALK_MERGES
    }

    fn doubled(&self) -> f64 {
        if self.many_merges() { 2.0 } else { 1.0 }
    }

    /// A point this far above a facet need not be compared with other facets.
    fn clearly_outside(&self) -> f64 {
        self.doubled() * f64::max(2.0 * self.tol.outside, self.max_outside)
    }

    /// Adapts the limit on coplanar points to the distances merging has caused.
    pub(super) fn raise_outside_limit(&mut self) {
        self.outside_limit = self.max_outside.max(self.tol.one_merge + self.tol.round).max(self.tol.outside);
    }

    /// Initial assignment: each facet takes the points clearly above it, the rest go to the best facet.
    pub(super) fn partition_all(&mut self) {
        let mut rest: Vec<usize> = (0..self.points.len()).collect();
        let corners: Vec<usize> =
            self.vertices_from(self.first_vertex).iter().map(|&v| self.vertices[v].point).collect();
        rest.retain(|p| !corners.contains(p));
        self.raise_outside_limit();
        let clearly_outside = self.clearly_outside();
        for f in self.facets_from(self.first_facet) {
            let mut best: Option<(usize, f64)> = None;
            let mut outside = Vec::new();
            rest.retain(|&p| {
                let distance = self.distance(self.points[p], f);
                if distance < clearly_outside {
                    return true;
                }
                match best {
                    Some((old, farthest)) if distance > farthest => {
                        outside.push(old);
                        best = Some((p, distance));
                    }
                    Some(_) => outside.push(p),
                    None => best = Some((p, distance)),
                }
                false
            });
            if let Some((p, distance)) = best {
                outside.push(p);
                self.facets[f].furthest = distance;
            }
            self.facets[f].outside = outside;
        }
        self.search_new = true;
        for p in rest {
            self.partition_point(p, self.first_facet);
        }
        self.search_new = false;
        self.settle();
        self.next_facet = self.first_facet;
        self.promote_farthest();
    }

    /// Makes the facet with the farthest outside point the next one.
    fn promote_farthest(&mut self) {
        let mut best = NONE;
        let mut farthest = -f64::MAX;
        let mut at = self.first_facet;
        while at != TAIL {
            if !self.facets[at].outside.is_empty() && self.facets[at].furthest > farthest {
                (best, farthest) = (at, self.facets[at].furthest);
            }
            at = self.facets[at].next;
        }
        if best != NONE {
            self.process_next(best);
        }
    }

    /// Takes the next outside point off its facet's set.
    pub(super) fn next_outside(&mut self, farthest_first: bool) -> Option<(usize, usize)> {
        while self.next_facet != TAIL {
            let facet = self.next_facet;
            if self.facets[facet].outside.is_empty() {
                self.next_facet = self.facets[facet].next;
                continue;
            }
            if self.narrow && self.furthest_of(facet) < self.tol.outside {
                self.next_facet = self.facets[facet].next;
                continue;
            }
            if farthest_first {
                self.promote_farthest();
            }
            let facet = self.next_facet;
            if let Some(point) = self.facets[facet].outside.pop() {
                return Some((point, facet));
            }
        }
        None
    }

    /// Height of the last outside point, after making it the farthest if it may not be.
    fn furthest_of(&mut self, facet: usize) -> f64 {
        if self.facets[facet].not_furthest {
            let mut best = (0, -f64::MAX);
            for (k, &p) in self.facets[facet].outside.iter().enumerate() {
                let distance = self.distance(self.points[p], facet);
                if distance > best.1 {
                    best = (k, distance);
                }
            }
            let f = &mut self.facets[facet];
            let point = f.outside.swap_remove(best.0);
            f.outside.push(point);
            f.furthest = best.1;
            f.not_furthest = false;
        }
        self.facets[facet].furthest
    }

    /// Puts a point into the outside or coplanar set of the best facet near `start`.
    pub(super) fn partition_point(&mut self, point: usize, start: usize) {
        let p = self.points[point];
        let mut best = if self.search_new {
            self.best_of_new(p, start, false)
        } else {
            self.best_by_walking(p, start, false, true)
        };
        if self.narrow && best.distance >= -self.tol.near_inside {
            best.outside = true;
        }
        if best.outside {
            self.add_outside(point, best.facet, best.distance);
        } else if best.distance >= -self.tol.near_inside {
            self.partition_coplanar(point, best.facet, Some(best.distance), self.search_new);
        }
    }

    fn add_outside(&mut self, point: usize, facet: usize, distance: f64) {
        let (narrow, outside) = (self.narrow, self.tol.outside);
        let f = &mut self.facets[facet];
        let mut first = false;
        if f.outside.is_empty() {
            f.outside.push(point);
            first = !narrow || distance > outside;
            f.furthest = distance;
        } else if f.furthest < distance {
            f.outside.push(point);
            first = narrow && f.furthest < outside && distance >= outside;
            f.furthest = distance;
        } else {
            push_before_last(&mut f.outside, point);
        }
        if first && self.next_facet != facet {
            if self.facets[facet].new {
                if self.facets[self.next_facet].new {
                    self.next_facet = self.first_new;
                }
            } else {
                self.requeue(facet);
                if self.first_new != NONE {
                    self.facets[facet].new = true;
                }
            }
        }
    }

    /// Remembers a point near a facet; `distance` is `None` when the facet must be searched for.
    pub(super) fn partition_coplanar(
        &mut self,
        point: usize,
        facet: usize,
        distance: Option<f64>,
        all_new: bool,
    ) {
        let p = self.points[point];
        let best = match distance {
            Some(distance) => Best { facet, distance, outside: false },
            None if all_new => self.best_of_new(p, facet, true),
            None => self.best_by_walking(p, facet, true, false),
        };
        if distance.is_none() && best.distance < -self.tol.near_inside {
            return;
        }
        if best.distance > self.max_outside {
            let around_the_edge =
                distance.is_none() && facet != best.facet && self.cosine(facet, best.facet) < 0.0;
            if around_the_edge || best.distance > self.outside_limit * OUTSIDE_RATIO {
                let search_new = std::mem::replace(&mut self.search_new, false);
                self.partition_point(point, best.facet);
                self.search_new = search_new;
                return;
            }
            self.max_outside = best.distance;
        }
        let last =
            self.facets[best.facet].coplanar.last().map(|&q| self.distance(self.points[q], best.facet));
        let coplanar = &mut self.facets[best.facet].coplanar;
        match last {
            Some(farthest) if farthest >= best.distance => push_before_last(coplanar, point),
            _ => coplanar.push(point),
        }
    }

    /// Walks uphill from `start`, among new facets only if `new_only`; stops at the first facet the
    /// point is outside of unless the `highest` is wanted.
    fn best_by_walking(&mut self, p: [f64; 3], start: usize, highest: bool, new_only: bool) -> Best {
        self.visit += 1;
        let visit = self.visit;
        let mut best = Best { facet: NONE, distance: -f64::MAX / 2.0, outside: true };
        if !self.facets[start].flipped {
            best.facet = start;
            best.distance = self.distance(p, start);
            if !highest && best.distance >= self.tol.outside {
                return best;
            }
        }
        self.facets[start].visit = visit;
        let mut at = start;
        while at != NONE {
            let mut next = NONE;
            for k in 0..self.facets[at].neighbors.len() {
                let n = self.facets[at].neighbors[k];
                let neighbor = &mut self.facets[n];
                if (new_only && !neighbor.new) || neighbor.visit == visit {
                    continue;
                }
                neighbor.visit = visit;
                if neighbor.flipped {
                    continue;
                }
                let distance = self.distance(p, n);
                if distance > best.distance {
                    best.facet = n;
                    best.distance = distance;
                    if !highest && distance >= self.tol.outside {
                        return best;
                    }
                    next = n;
                    break;
                }
            }
            at = next;
        }
        if new_only {
            if best.facet == NONE {
                return self.best_of_new(p, self.first_new, highest);
            }
            if !self.new_not_sharp && best.distance < -self.tol.round {
                if self.new_facets_are_sharp() {
                    let best = self.best_of_new(p, best.facet, highest);
                    self.search_new = true;
                    return best;
                }
                self.new_not_sharp = true;
            }
        }
        if best.facet == NONE {
            best = self.best_of_all(p);
        }
        self.climb_coplanar(p, &mut best);
        best.outside = best.distance >= self.tol.outside;
        best
    }

    /// Last resort when all facets around the start are flipped.
    fn best_of_all(&self, p: [f64; 3]) -> Best {
        let mut best = Best { facet: self.first_facet, distance: -f64::MAX, outside: false };
        for f in self.facets_from(self.first_facet) {
            let facet = &self.facets[f];
            if facet.flipped || facet.visible || facet.normal.is_none() {
                continue;
            }
            let distance = self.distance(p, f);
            if distance > best.distance {
                (best.facet, best.distance) = (f, distance);
            }
        }
        best
    }

    /// Searches the new facets, beginning with `start`.
    fn best_of_new(&mut self, p: [f64; 3], start: usize, highest: bool) -> Best {
        self.visit += 1;
        let visit = self.visit;
        let clearly_outside = if highest { f64::MAX } else { self.clearly_outside() };
        let mut best = Best { facet: NONE, distance: -f64::MAX / 2.0, outside: true };
        for (pass, first) in [start, self.first_new].into_iter().enumerate() {
            let mut at = first;
            while at != NONE && at != TAIL && !(pass == 1 && at == start) {
                self.facets[at].visit = visit;
                if !self.facets[at].flipped {
                    let distance = self.distance(p, at);
                    if distance > best.distance {
                        (best.facet, best.distance) = (at, distance);
                        if distance >= clearly_outside {
                            return best;
                        }
                    }
                }
                at = self.facets[at].next;
            }
        }
        if best.facet == NONE {
            best.facet = start;
        }
        self.climb_coplanar(p, &mut best);
        best.outside = best.distance >= self.tol.outside;
        best
    }

    /// Follows neighbours that are not clearly lower, as round-off may hide a better facet behind them.
    fn climb_coplanar(&mut self, p: [f64; 3], best: &mut Best) {
        self.visit += 1;
        let visit = self.visit;
        let reach = self.doubled() * (self.max_outside + 2.0 * self.tol.round + self.tol.visible);
        let mut least = best.distance - reach;
        let mut pending = std::mem::take(&mut self.search_stack);
        pending.clear();
        let mut at = best.facet;
        self.facets[at].visit = visit;
        loop {
            let mut next = NONE;
            for k in 0..self.facets[at].neighbors.len() {
                let n = self.facets[at].neighbors[k];
                if self.facets[n].visit == visit {
                    continue;
                }
                self.facets[n].visit = visit;
                if !self.facets[n].flipped {
                    let distance = self.distance(p, n);
                    if distance > best.distance {
                        least = distance - reach;
                        if distance > best.distance + reach {
                            pending.clear();
                        }
                        (best.facet, best.distance) = (n, distance);
                    } else if distance < least {
                        continue;
                    }
                }
                if next != NONE {
                    pending.push(next);
                }
                next = n;
            }
            at = if next != NONE {
                next
            } else if let Some(f) = pending.pop() {
                f
            } else {
                break;
            };
        }
        self.search_stack = pending;
    }

    /// Whether the new facets face more than one octant.
    fn new_facets_are_sharp(&self) -> bool {
        let octant = |f: usize| self.facets[f].normal.unwrap_or_default().map(|x| x > 0.0);
        let mut at = self.first_new;
        let first = octant(at);
        while at != NONE && at != TAIL {
            if octant(at) != first {
                return true;
            }
            at = self.facets[at].next;
        }
        false
    }

    /// Hands on the points of visible facets and the points of vertices that ceased to be one.
    pub(super) fn partition_visible(&mut self) {
        let mut visible = self.first_visible;
        while visible != NONE && visible != TAIL && self.facets[visible].visible {
            let outside = std::mem::take(&mut self.facets[visible].outside);
            let coplanar = std::mem::take(&mut self.facets[visible].coplanar);
            if !outside.is_empty() || !coplanar.is_empty() {
                let mut start = self.replacement(visible);
                if start == NONE {
                    start = self.first_new;
                }
                for point in outside {
                    self.partition_point(point, start);
                }
                for point in coplanar {
                    self.partition_coplanar(point, start, None, self.search_new);
                }
            }
            visible = self.facets[visible].next;
        }
        for k in 0..self.deleted_vertices.len() {
            let v = self.deleted_vertices[k];
            if !self.vertices[v].partitioned {
                self.partition_coplanar(self.vertices[v].point, self.first_new, None, true);
                self.vertices[v].partitioned = true;
            }
        }
    }
}
