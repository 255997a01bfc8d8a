//! Which facet a point belongs to.
//!
//! The facets above which a point lies are connected, so a walk that goes on to any higher neighbour finds
//! one of them, and it may stop there: any will do for a point that has to be added. Where the surface is
//! blunt a walk works for points below all facets too; where fresh facets meet at sharp angles, or unions
//! have bent the hull, it may end at a local maximum, and all fresh facets are compared instead.

use super::builder::{Builder, Search};
use super::id::{FacetId, Marks};
use super::surface::{Facet, Phase};

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Goal {
    /// A fresh facet the point is outside of, or else the highest.
    Outside,
    /// The facet the point is highest above.
    Highest,
}

/// A facet and the height of the point above it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub facet: FacetId,
    pub height: f64,
}

impl Builder<'_> {
    /// Goes from facet to facet, each higher than the one before, starting with `start`. The neighbour that
    /// is listed first wins, whichever is highest.
    pub(super) fn walk(&mut self, point: [f64; 3], start: FacetId, goal: Goal) -> Found {
        let enough = if goal == Goal::Outside { self.tol.outside } else { f64::INFINITY };
        let best = self.ascend(point, start, goal, enough);
        if best.height >= enough {
            return best;
        }
        if goal == Goal::Outside && !self.search.blunt && best.height < -self.tol.round {
            if self.fresh_facets_are_sharp() {
                self.search.sweep = true;
                return self.sweep(point, best.facet, goal);
            }
            self.search.blunt = true;
        }
        self.cross_plateau(point, best)
    }

    fn ascend(&mut self, point: [f64; 3], start: FacetId, goal: Goal, enough: f64) -> Found {
        let facets = &self.surface.facets;
        let passed = &mut self.surface.passed;
        passed.clear();
        passed.add(start);
        let mut best = Found { facet: start, height: height(&facets[start], point).unwrap_or(f64::MIN) };
        while best.height < enough {
            let higher = facets[best.facet].neighbors.iter().find_map(|&facet| {
                let neighbor = &facets[facet];
                if goal == Goal::Outside && neighbor.phase != Phase::Fresh || !passed.add(facet) {
                    return None;
                }
                let height = height(neighbor, point).filter(|&height| height > best.height)?;
                Some(Found { facet, height })
            });
            match higher {
                Some(found) => best = found,
                None => break,
            }
        }
        best
    }

    /// Compares the facets from `start` to the last, then the other fresh ones; the first of equals wins.
    pub(super) fn sweep(&mut self, point: [f64; 3], start: FacetId, goal: Goal) -> Found {
        let enough = match goal {
            Goal::Outside => self.slack.clearly_outside(&self.tol),
            Goal::Highest => f64::INFINITY,
        };
        let order = self.surface.agenda.order();
        let rest = order.fresh().take_while(|&facet| facet != start);
        let mut best = Found { facet: start, height: f64::MIN };
        for facet in order.from(Some(start)).chain(rest) {
            let Some(height) = height(&self.surface.facets[facet], point) else { continue };
            if height > best.height {
                best = Found { facet, height };
                if height >= enough {
                    return best;
                }
            }
        }
        self.cross_plateau(point, best)
    }

    /// Searches on from a facet through those that are lower by no more than the plateau, as round-off may
    /// hide a higher one behind them. Of the facets to go on from, the one found last is taken first.
    fn cross_plateau(&mut self, point: [f64; 3], mut best: Found) -> Found {
        let plateau = self.slack.plateau(&self.tol);
        let mut lowest = best.height - plateau;
        let facets = &self.surface.facets;
        let Search { pending, .. } = &mut self.search;
        let passed: &mut Marks<FacetId> = &mut self.surface.passed;
        passed.clear();
        passed.add(best.facet);
        pending.clear();
        pending.push(best.facet);
        while let Some(at) = pending.pop() {
            let mut others = pending.len();
            for &facet in &facets[at].neighbors {
                if !passed.add(facet) {
                    continue;
                }
                let height = height(&facets[facet], point);
                if let Some(height) = height.filter(|&height| height > best.height) {
                    lowest = height - plateau;
                    if height > best.height + plateau {
                        // Of the facets to go on from, only the latest neighbour of this one stays.
                        pending.drain(..others.max(pending.len().saturating_sub(1)));
                        others = 0;
                    }
                    best = Found { facet, height };
                } else if height.is_some_and(|height| height < lowest) {
                    continue;
                }
                pending.push(facet);
            }
        }
        best
    }

    /// Whether the fresh facets face more than one octant.
    fn fresh_facets_are_sharp(&self) -> bool {
        let octant = |facet: FacetId| self.surface.facets[facet].plane.normal.map(|x| x > 0.0);
        let mut octants = self.surface.agenda.order().fresh().map(octant);
        let first = octants.next();
        octants.any(|octant| Some(octant) != first)
    }
}

/// Height of a point above a facet whose plane can be trusted.
fn height(facet: &Facet, point: [f64; 3]) -> Option<f64> {
    (!facet.inverted).then(|| facet.plane.height(point))
}
