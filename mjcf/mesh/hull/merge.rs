//! Which facets are united, and in which order, until the hull is convex within round-off.
//!
//! A union replaces two planes by one of them, so a facet goes to the neighbour whose plane fits its corners
//! best, and the unions that bend the hull least come first: they often settle the others.

use super::builder::Builder;
use super::cone::Level;
use super::convexity::{Bend, BendKind};
use super::failure::Failure;
use super::id::{FacetId, Marks};
use super::slivers::Sliver;
use super::surface::{Convexity, Phase};

/// Facets with more corners than this are measured at their centre.
const MANY_CORNERS: usize = 2 * 3 + 20;
/// Facets with more corners than this go to a neighbour they are not convex to.
const SOME_CORNERS: usize = 3 + 15;
/// Estimate of the largest height of a corner, as a multiple of that of the centre.
const CENTER_FACTOR: f64 = 3.0;

/// Heights of the corners of a facet below and above the plane of another.
#[derive(Debug, Clone, Copy)]
struct Range {
    below: f64,
    above: f64,
}

impl Range {
    fn of(heights: impl Iterator<Item = f64>) -> Self {
        heights.fold(Self { below: 0.0, above: 0.0 }, |range, height| Self {
            below: range.below.min(height),
            above: range.above.max(height),
        })
    }

    fn largest(self) -> f64 {
        self.above.max(-self.below)
    }
}

/// A neighbour that a facet could be united with.
#[derive(Debug, Clone, Copy)]
struct Host {
    facet: FacetId,
    /// How far the plane is from the corners of the other facet, estimated at its centre if there are many.
    distance: f64,
    range: Range,
    inverted: bool,
}

impl Builder<'_> {
    /// Unites fresh facets until the hull is convex. `level` triangles go first: they have no plane, and were
    /// made to continue the facet beyond.
    pub(super) fn make_convex(&mut self, level: Vec<Level>) -> Result<(), Failure> {
        if level.is_empty() && self.cone_is_convex() {
            return Ok(());
        }
        self.grown.clear();
        let mut united = self.join_level(level)?;
        united |= self.unite_inverted()?;
        let mut bends = self.bends_of_fresh();
        loop {
            while !bends.is_empty() {
                for bend in bends {
                    united |= self.straighten(bend)?;
                }
                bends = self.bends_of_changed();
            }
            if !united || !self.dissolve_vertices()? {
                break;
            }
            united = false;
            bends = self.bends_of_changed();
        }
        match self.surface.agenda.order().first_fresh() {
            Some(_) => Ok(()),
            None => Err(Failure("all fresh facets were united with others")),
        }
    }

    /// Unites each level triangle with the facet beyond; whether there was one.
    fn join_level(&mut self, level: Vec<Level>) -> Result<bool, Failure> {
        let united = !level.is_empty();
        let mut extended = Marks::default();
        for Level { triangle, beyond } in level {
            self.absorb(triangle, beyond)?;
            extended.add(beyond);
        }
        let mut at = self.surface.agenda.order().first_fresh();
        while let Some(facet) = at {
            if extended.has(facet) {
                self.find_covered_neighbors(facet);
            }
            at = self.surface.agenda.order().after(facet);
        }
        self.unite_slivers()?;
        Ok(united)
    }

    /// Unites the facets that face the interior with their neighbours; whether there was one.
    fn unite_inverted(&mut self) -> Result<bool, Failure> {
        let order = self.surface.agenda.order();
        let inverted: Vec<FacetId> =
            order.fresh().filter(|&facet| self.surface.facets[facet].inverted).collect();
        let mut united = false;
        for facet in inverted {
            if !self.surface.facets[facet].phase.is_removed() {
                let host = self.host_of(facet)?;
                self.merge(facet, host)?;
                united = true;
            }
        }
        self.unite_slivers()?;
        Ok(united)
    }

    /// Unites one of two facets that are not convex to each other with the neighbour that fits best; false if
    /// they have changed since.
    fn straighten(&mut self, bend: Bend) -> Result<bool, Failure> {
        let Bend { kind, first, second, .. } = bend;
        let facets = &self.surface.facets;
        if facets[first].phase.is_removed() || facets[second].phase.is_removed() {
            return Ok(false);
        }
        let changed = |facet: FacetId| !facets[facet].tested && facets[facet].phase == Phase::Fresh;
        if kind == BendKind::Flat && (changed(first) || changed(second)) {
            return Ok(false);
        }
        let (a, b) = if facets[first].phase == Phase::Fresh { (first, second) } else { (second, first) };
        let [for_a, for_b] = [self.host_of(a)?, self.host_of(b)?];
        if for_a.distance < for_b.distance {
            self.merge(a, for_a)?;
        } else {
            self.merge(b, for_b)?;
        }
        self.unite_slivers()?;
        Ok(true)
    }

    /// Dissolves the vertices inside edges of grown facets; whether facets became slivers and were united.
    fn dissolve_vertices(&mut self) -> Result<bool, Failure> {
        let mut united = false;
        loop {
            let mut at = self.surface.agenda.order().first_fresh();
            while let Some(facet) = at {
                if self.grown.remove(facet) {
                    for changed in self.surface.dissolve_corners(facet) {
                        self.find_sliver(changed);
                    }
                }
                at = self.surface.agenda.order().after(facet);
            }
            if !self.unite_slivers()? {
                break;
            }
            united = true;
        }
        self.surface.tighten();
        Ok(united)
    }

    /// The neighbour whose plane is nearest to the corners of `facet`, the first of equals. An upright one
    /// is not given up for an inverted one if the facet is inverted itself.
    fn host_of(&mut self, facet: FacetId) -> Result<Host, Failure> {
        let corners = self.surface.facets[facet].corners.len();
        let center = (corners > MANY_CORNERS).then(|| self.center_of(facet));
        let nonconvex = if corners > SOME_CORNERS { self.nonconvex_neighbors(facet) } else { Vec::new() };
        let neighbors =
            if nonconvex.is_empty() { self.surface.facets[facet].neighbors.clone() } else { nonconvex };
        let inverted = self.surface.facets[facet].inverted;
        let mut best: Option<Host> = None;
        for neighbor in neighbors {
            let range = match center {
                Some(center) => Range::of(std::iter::once(CENTER_FACTOR * self.height(center, neighbor))),
                None => self.corner_range(facet, neighbor),
            };
            let distance = range.largest();
            let host =
                Host { facet: neighbor, distance, range, inverted: self.surface.facets[neighbor].inverted };
            let better = best.is_none_or(|best| {
                !(inverted && host.inverted && !best.inverted) && distance < best.distance
            });
            if better {
                best = Some(host);
            }
        }
        let mut best = best.ok_or(Failure("a facet has no neighbour to be united with"))?;
        if center.is_some() {
            best.range = self.corner_range(facet, best.facet);
        }
        Ok(best)
    }

    fn nonconvex_neighbors(&self, facet: FacetId) -> Vec<FacetId> {
        let ridges = self.surface.facets[facet].ridges.iter().map(|&ridge| &self.surface.ridges[ridge]);
        ridges
            .filter(|ridge| ridge.convexity == Convexity::Nonconvex)
            .map(|ridge| ridge.beyond(facet))
            .collect()
    }

    /// Heights of the corners of `facet` that are not shared, above and below the plane of `neighbor`.
    fn corner_range(&mut self, facet: FacetId, neighbor: FacetId) -> Range {
        self.surface.mark_corners(neighbor);
        let surface = &self.surface;
        let corners = surface.facets[facet].corners.iter().filter(|&&corner| !surface.own.has(corner));
        Range::of(corners.map(|&corner| self.height(self.points[surface.vertices[corner].point], neighbor)))
    }

    /// Unites a facet with its host and looks for slivers around them.
    fn merge(&mut self, facet: FacetId, host: Host) -> Result<(), Failure> {
        let Host { facet: into, range, .. } = host;
        self.slack.allow(range.above);
        if range.largest() > self.tol.wide {
            self.surface.facets[into].pinned = true;
        }
        self.absorb(facet, into)?;
        self.find_slivers_around(facet, into);
        Ok(())
    }

    fn absorb(&mut self, facet: FacetId, into: FacetId) -> Result<(), Failure> {
        self.slack.count_union();
        let removed = [facet, into].iter().any(|&facet| self.surface.facets[facet].phase.is_removed());
        if removed || facet == into {
            return Err(Failure("a facet was to be united twice"));
        }
        if self.surface.agenda.order().len() <= 4 {
            return Err(Failure("too few facets are left"));
        }
        self.surface.unite(facet, into)?;
        self.grown.add(into);
        Ok(())
    }

    /// Unites all slivers with others; whether there was one.
    fn unite_slivers(&mut self) -> Result<bool, Failure> {
        let mut united = false;
        while let Some(sliver) = self.slivers.next() {
            match sliver {
                Sliver::Covered { facet, .. } | Sliver::Thin(facet)
                    if self.surface.facets[facet].phase.is_removed() => {}
                Sliver::Covered { facet, by } => {
                    let lost = Failure("a covered facet has lost its neighbour");
                    let into = self.surface.heir(by).ok_or(lost)?;
                    if into != facet {
                        self.absorb(facet, into)?;
                        self.find_slivers_around(facet, into);
                        united = true;
                    }
                }
                Sliver::Thin(facet) => {
                    if self.surface.facets[facet].neighbors.len() < 3 {
                        let host = self.host_of(facet)?;
                        self.merge(facet, host)?;
                        united = true;
                    }
                }
            }
        }
        Ok(united)
    }

    /// Looks for slivers where `gone` has been united with `into`.
    fn find_slivers_around(&mut self, gone: FacetId, into: FacetId) {
        self.find_covered_neighbors(into);
        for k in 0..self.surface.facets[gone].neighbors.len() {
            let neighbor = self.surface.facets[gone].neighbors[k];
            if self.surface.facets[neighbor].neighbors.len() < 3 {
                self.slivers.add_thin(neighbor);
            }
        }
        self.find_sliver(into);
    }

    /// Notes neighbours whose corners are all corners of `facet`, or that `facet` itself is thin. An inverted
    /// facet does not take an upright one.
    fn find_covered_neighbors(&mut self, facet: FacetId) {
        if self.surface.facets[facet].neighbors.len() < 3 {
            self.slivers.add_thin(facet);
            return;
        }
        self.surface.mark_corners(facet);
        let inverted = self.surface.facets[facet].inverted;
        for &neighbor in &self.surface.facets[facet].neighbors {
            let protected = inverted && !self.surface.facets[neighbor].inverted;
            if !self.slivers.has(neighbor) && !protected && self.surface.all_corners_marked(neighbor) {
                self.slivers.add_covered(neighbor, facet);
            }
        }
    }

    /// Notes `facet` if all its corners are a neighbour's, or if it is thin.
    fn find_sliver(&mut self, facet: FacetId) {
        if self.surface.facets[facet].inverted {
            return;
        }
        for k in 0..self.surface.facets[facet].neighbors.len() {
            let neighbor = self.surface.facets[facet].neighbors[k];
            if self.surface.facets[neighbor].inverted {
                continue;
            }
            self.surface.mark_corners(neighbor);
            if self.surface.all_corners_marked(facet) {
                self.slivers.add_covered(facet, neighbor);
                return;
            }
        }
        if self.surface.facets[facet].neighbors.len() < 3 {
            self.slivers.add_thin(facet);
        }
    }
}
