//! Which facets are united, and in which order, until the hull is convex within round-off.
//!
//! A union replaces two planes by one of them, so a facet goes to the neighbour whose plane fits its corners
//! best, and the unions that bend the hull least come first: they often settle the others (Barber, Dobkin and Huhdanpaa,
//! "The Quickhull algorithm for convex hulls", 1996, section 4).

use super::builder::Builder;
use super::cone::Level;
use super::convexity::{Bend, BendKind};
use super::failure::Failure;
use super::id::{FacetId, Marks};
use super::slivers::Sliver;
use super::surface::{Convexity, Facet, Phase};

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

impl Host {
    /// Whether to take this one, found later than `best`. A facet that is `inverted` itself does not give up an upright
    /// neighbour for an inverted one.
    fn is_preferred_to(&self, best: &Host, inverted: bool) -> bool {
        let turns_over = inverted && self.inverted && !best.inverted;
        !turns_over && self.distance < best.distance
    }
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
        let bends = self.bends_of_fresh();
        united |= self.straighten_all(bends)?;
        // Each union may leave vertices inside edges, and facets without them may be slivers or bend to others.
        while united && self.dissolve_vertices()? {
            let bends = self.bends_of_changed();
            united = self.straighten_all(bends)?;
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

    /// Straightens bends until unions make no new ones; whether there were unions.
    fn straighten_all(&mut self, mut bends: Vec<Bend>) -> Result<bool, Failure> {
        let mut united = false;
        while !bends.is_empty() {
            for bend in bends {
                if self.is_current(&bend) {
                    self.straighten(bend)?;
                    united = true;
                }
            }
            bends = self.bends_of_changed();
        }
        Ok(united)
    }

    /// Whether both facets of a bend are still there. A flat one counts only as it was measured.
    fn is_current(&self, bend: &Bend) -> bool {
        [bend.first, bend.second].into_iter().all(|facet| {
            let facet = &self.surface.facets[facet];
            let measured = facet.tested || facet.phase != Phase::Fresh;
            !facet.phase.is_removed() && (measured || bend.kind != BendKind::Flat)
        })
    }

    /// Removes a bend: that one of its facets is united with a neighbour, not always the other one, for which a
    /// neighbour's plane is nearer. Of equals it is the second, a fresh facet counting as the first.
    fn straighten(&mut self, bend: Bend) -> Result<(), Failure> {
        let mut sides = [bend.first, bend.second];
        if self.surface.facets[bend.first].phase != Phase::Fresh {
            sides.reverse();
        }
        let [one, other] = sides;
        let (host, other_host) = (self.host_of(one)?, self.host_of(other)?);
        let nearer = if host.distance < other_host.distance { (one, host) } else { (other, other_host) };
        self.merge(nearer.0, nearer.1)?;
        self.unite_slivers()?;
        Ok(())
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

    /// The neighbour whose plane is nearest to the corners of `facet`, the first of equals. Facets with many corners are
    /// measured at their centre, which takes one height for each neighbour, and only the chosen plane at all corners.
    fn host_of(&mut self, facet: FacetId) -> Result<Host, Failure> {
        let Facet { ref corners, inverted, .. } = self.surface.facets[facet];
        let measured_at = (corners.len() > MANY_CORNERS).then(|| self.center_of(facet));
        let hosts = self.candidates(facet).into_iter().map(|neighbor| {
            let range = match measured_at {
                Some(center) => Range::of(std::iter::once(CENTER_FACTOR * self.height(center, neighbor))),
                None => self.corner_range(facet, neighbor),
            };
            let inverted = self.surface.facets[neighbor].inverted;
            Host { facet: neighbor, distance: range.largest(), range, inverted }
        });
        let nearest =
            hosts.reduce(|best, host| if host.is_preferred_to(&best, inverted) { host } else { best });
        let mut host = nearest.ok_or(Failure("a facet has no neighbour to be united with"))?;
        if measured_at.is_some() {
            host.range = self.corner_range(facet, host.facet);
        }
        Ok(host)
    }

    /// The neighbours that `facet` may be united with: all, or those it bends to if it has some corners.
    fn candidates(&self, facet: FacetId) -> Vec<FacetId> {
        let Facet { corners, neighbors, .. } = &self.surface.facets[facet];
        let bent = if corners.len() > SOME_CORNERS { self.nonconvex_neighbors(facet) } else { Vec::new() };
        if bent.is_empty() { neighbors.clone() } else { bent }
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
                    if self.surface.facets[facet].is_thin() {
                        let host = self.host_of(facet)?;
                        self.merge(facet, host)?;
                        united = true;
                    }
                }
            }
        }
        Ok(united)
    }

    /// Notes the slivers where `gone` has been united with `into`: neighbours of both have lost one, and `into` may now have all
    /// corners of a neighbour, or lie within one.
    fn find_slivers_around(&mut self, gone: FacetId, into: FacetId) {
        self.find_covered_neighbors(into);
        let facets = &self.surface.facets;
        for &neighbor in facets[gone].neighbors.iter().filter(|&&neighbor| facets[neighbor].is_thin()) {
            self.slivers.add_thin(neighbor);
        }
        self.find_sliver(into);
    }

    /// Notes neighbours that `facet` covers, or that `facet` itself is thin. An inverted facet does not take an upright one.
    fn find_covered_neighbors(&mut self, facet: FacetId) {
        let facets = &self.surface.facets;
        let host = &facets[facet];
        if host.is_thin() {
            self.slivers.add_thin(facet);
            return;
        }
        for &neighbor in &host.neighbors {
            let covered = &facets[neighbor];
            let allowed = covered.inverted || !host.inverted;
            if allowed && !self.slivers.has(neighbor) && host.covers(covered) {
                self.slivers.add_covered(neighbor, facet);
            }
        }
    }

    /// Notes `facet` if it is upright and a sliver: covered by an upright neighbour, the first in its list, or else thin.
    fn find_sliver(&mut self, facet: FacetId) {
        let facets = &self.surface.facets;
        let suspect = &facets[facet];
        if suspect.inverted {
            return;
        }
        let covers = |&&host: &&FacetId| !facets[host].inverted && facets[host].covers(suspect);
        if let Some(&host) = suspect.neighbors.iter().find(covers) {
            self.slivers.add_covered(facet, host);
        } else if suspect.is_thin() {
            self.slivers.add_thin(facet);
        }
    }
}
