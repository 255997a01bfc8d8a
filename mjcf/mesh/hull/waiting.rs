//! Points that wait at facets: those above a facet to be added to the hull, those within round-off to be
//! looked at again when the facet disappears.
//!
//! A point waits at one facet only, so a step looks again at the points of the facets it removes and at no
//! others.

use super::builder::Builder;
use super::id::FacetId;
use super::locate::{Found, Goal};
use super::surface::{Phase, Surface};

/// A point this many times higher than the limit above the facet it would stay with has to be added.
const FAR_OUTSIDE: f64 = 30.0;

impl Builder<'_> {
    /// Assigns all points but the corners of the first tetrahedron. Points clearly above a facet go to the
    /// first such facet, which spares comparing most points with all four.
    pub(super) fn assign_all(&mut self) {
        let Surface { agenda, vertices, vertex_order, .. } = &self.surface;
        let facets: Vec<FacetId> = agenda.order().iter().collect();
        let corners: Vec<usize> = vertex_order.iter().map(|vertex| vertices[vertex].point).collect();
        let mut rest: Vec<usize> = (0..self.points.len()).filter(|p| !corners.contains(p)).collect();
        self.slack.raise_limit(&self.tol);
        let enough = self.slack.clearly_outside(&self.tol);
        for facet in facets {
            rest.retain(|&point| {
                let height = self.surface.facets[facet].plane.height(self.points[point]);
                let above = height >= enough;
                if above {
                    self.surface.facets[facet].wait_outside(point, height);
                }
                !above
            });
        }
        for point in rest {
            let Some(first) = self.surface.agenda.order().first() else { break };
            let found = self.sweep(self.points[point], first, Goal::Outside);
            self.wait(point, found);
        }
        self.surface.finish_step();
        self.surface.agenda.rewind();
        self.promote_highest();
    }

    /// The next point to be added and the facet it waited at.
    pub(super) fn next_point(&mut self, highest_first: bool) -> Option<(usize, FacetId)> {
        while let Some(facet) = self.surface.agenda.cursor() {
            let waiting = &self.surface.facets[facet];
            // A narrow hull keeps points here that are hardly above the facet.
            let idle = waiting.outside.is_empty() || self.narrow && waiting.reach < self.tol.outside;
            if idle {
                self.surface.agenda.advance();
                continue;
            }
            if highest_first {
                self.promote_highest();
            }
            let facet = self.surface.agenda.cursor()?;
            return self.surface.facets[facet].outside.pop().map(|point| (point, facet));
        }
        None
    }

    /// Brings the facet with the highest point to the cursor: with few vertices allowed, the largest
    /// extension comes first.
    fn promote_highest(&mut self) {
        let mut highest: Option<FacetId> = None;
        for facet in self.surface.agenda.order().iter() {
            let waiting = |facet: FacetId| &self.surface.facets[facet];
            if !waiting(facet).outside.is_empty()
                && highest.is_none_or(|highest| waiting(facet).reach > waiting(highest).reach)
            {
                highest = Some(facet);
            }
        }
        if let Some(facet) = highest {
            self.surface.agenda.promote(facet);
        }
    }

    /// Gives the points of the removed facets and of the lost vertices to the facets that are there now.
    /// Points of facets that were united last come first.
    pub(super) fn reassign(&mut self) {
        let Some(first_fresh) = self.surface.agenda.order().first_fresh() else { return };
        let order = self.surface.agenda.order();
        let all_triangles = order.fresh().all(|facet| self.surface.facets[facet].shape.is_triangle());
        self.search.sweep = self.slack.many_unions() || !all_triangles;
        self.search.blunt = false;
        let Surface { absorbed, hidden, .. } = &self.surface;
        let removed: Vec<FacetId> = absorbed.iter().rev().chain(hidden).copied().collect();
        for facet in removed {
            let outside = std::mem::take(&mut self.surface.facets[facet].outside);
            let near = std::mem::take(&mut self.surface.facets[facet].near);
            let start = self.surface.heir(facet).unwrap_or(first_fresh);
            for &point in &outside {
                self.assign(point, start);
            }
            for &point in &near {
                self.assign_near(point, start, self.search.sweep);
            }
            // The lists keep their memory for the next triangle.
            let facet = &mut self.surface.facets[facet];
            (facet.outside, facet.near) = (outside, near);
        }
        for k in 0..self.surface.lost.len() {
            let point = self.surface.vertices[self.surface.lost[k]].point;
            self.assign_near(point, first_fresh, true);
        }
    }

    /// Finds the place of a point that was outside the hull.
    fn assign(&mut self, point: usize, start: FacetId) {
        let p = self.points[point];
        let found = match self.search.sweep {
            true => self.sweep(p, start, Goal::Outside),
            false => self.walk(p, start, Goal::Outside),
        };
        self.wait(point, found);
    }

    /// Finds the place of a point that was on the hull or within round-off. Unions may have bent the hull so
    /// far that it is outside now.
    fn assign_near(&mut self, point: usize, start: FacetId, sweep: bool) {
        let p = self.points[point];
        let found = match sweep {
            true => self.sweep(p, start, Goal::Highest),
            false => self.walk(p, start, Goal::Highest),
        };
        if found.height < -self.tol.near {
            return;
        }
        let plane = |facet: FacetId| &self.surface.facets[facet].plane;
        let around_an_edge = plane(start).cosine(plane(found.facet)) < 0.0;
        let too_far = found.height > self.slack.limit * FAR_OUTSIDE;
        if found.height > self.slack.highest && (around_an_edge || too_far) {
            let found = self.walk_once(p, found.facet);
            self.wait(point, found);
        } else {
            self.wait_near(point, found);
        }
    }

    /// A walk that does not change how later points are searched for.
    fn walk_once(&mut self, point: [f64; 3], start: FacetId) -> Found {
        let sweep = self.search.sweep;
        let found = self.walk(point, start, Goal::Outside);
        self.search.sweep = sweep;
        found
    }

    /// Lets a point wait at the facet found for it, or drops it if it is inside the hull.
    fn wait(&mut self, point: usize, found: Found) {
        let outside = if self.narrow { -self.tol.near } else { self.tol.outside };
        if found.height >= outside {
            self.wait_outside(point, found);
        } else if found.height >= -self.tol.near {
            self.wait_near(point, found);
        }
    }

    /// A settled facet that gets its first point goes behind the facets of this step, so that points are
    /// added all over the hull before the next point of one region.
    fn wait_outside(&mut self, point: usize, Found { facet, height }: Found) {
        let waiting = &mut self.surface.facets[facet];
        let first = match waiting.outside.is_empty() {
            true => !self.narrow || height > self.tol.outside,
            false => self.narrow && waiting.reach < self.tol.outside && height >= self.tol.outside,
        };
        waiting.wait_outside(point, height);
        if first && waiting.phase == Phase::Settled && self.surface.agenda.cursor() != Some(facet) {
            self.surface.freshen_facet(facet);
        }
    }

    fn wait_near(&mut self, point: usize, Found { facet, height }: Found) {
        self.slack.allow(height);
        let plane = self.surface.facets[facet].plane;
        let near = &mut self.surface.facets[facet].near;
        let lower = near.last().is_some_and(|&last| plane.height(self.points[last]) >= height);
        insert_waiting(near, point, !lower);
    }
}

impl super::surface::Facet {
    /// Adds a point above the facet, as the last if it is the highest.
    fn wait_outside(&mut self, point: usize, height: f64) {
        let highest = self.outside.is_empty() || height > self.reach;
        insert_waiting(&mut self.outside, point, highest);
        if highest {
            self.reach = height;
        }
    }
}

/// Adds a point as the last one, or in front of the last one.
fn insert_waiting(list: &mut Vec<usize>, point: usize, last: bool) {
    let at = if last { list.len() } else { list.len().saturating_sub(1) };
    list.insert(at, point);
}
