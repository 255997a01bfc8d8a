//! Merging all new facets with the same coplanar horizon facet at once.

use super::Failure;
use super::merge::Reason;
use super::polytope::{NONE, Polytope, TAIL, remove_ordered, remove_unordered, replace_item};

/// Facets with more vertices than this keep their centre.
const KEEP_CENTER_VERTICES: usize = 3 + 5;

impl Polytope<'_> {
    /// Merges every ring of new facets into its horizon facet; whether there was one.
    pub(super) fn merge_cycles(&mut self) -> Result<bool, Failure> {
        let mut merged = false;
        let mut facet = self.first_new;
        while facet != NONE && facet != TAIL {
            let mut next = self.facets[facet].next;
            if self.facets[facet].normal.is_some() {
                facet = next;
                continue;
            }
            if !self.facets[facet].merge_horizon {
                return Err(Failure("a new facet has no plane"));
            }
            let horizon = self.facets[facet].neighbors[0];
            if self.facets[facet].same_cycle == facet {
                for k in 1..3 {
                    let v = self.facets[facet].vertices[k];
                    self.vertices[v].lost_ridge = true;
                }
                self.facets[horizon].new_cycle = NONE;
                self.merge_facet(facet, horizon, Reason::CoplanarHorizon, None)?;
            } else {
                let ring = self.ring_of(facet);
                for &same in &ring {
                    if self.facets[same].cycle_done || self.facets[same].visible {
                        return Err(Failure("rings of coplanar facets overlap"));
                    }
                    self.facets[same].cycle_done = true;
                }
                while next != NONE && self.facets[next].cycle_done {
                    next = self.facets[next].next;
                }
                self.facets[horizon].new_cycle = NONE;
                self.merge_ring(&ring, horizon)?;
            }
            merged = true;
            facet = next;
        }
        if merged {
            for f in self.facets_from(self.first_new) {
                if self.facets[f].coplanar_horizon {
                    self.queue_redundant_neighbors(f);
                    self.facets[f].coplanar_horizon = false;
                }
            }
            self.merge_degenerate()?;
        }
        Ok(merged)
    }

    /// The ring a facet is in, the facet itself last.
    fn ring_of(&self, facet: usize) -> Vec<usize> {
        let mut ring = Vec::new();
        let mut at = self.facets[facet].same_cycle;
        while at != NONE && ring.len() <= self.facets.len() {
            ring.push(at);
            if at == facet {
                break;
            }
            at = self.facets[at].same_cycle;
        }
        ring
    }

    /// Merges a ring, which has at least two facets, into `horizon`.
    fn merge_ring(&mut self, ring: &[usize], horizon: usize) -> Result<(), Failure> {
        self.merge_count += 1;
        self.ensure_vertex_neighbors();
        let apex = self.facets[ring[0]].vertices[0];
        self.make_ridges(horizon);
        let in_ring = self.take_over_neighbors(ring, horizon)?;
        self.take_over_ridges(ring, horizon, in_ring)?;
        self.take_over_vertices(ring, horizon, apex);
        if self.facets[horizon].vertices.first() != Some(&apex) {
            self.facets[horizon].vertices.insert(0, apex);
        }
        if !self.facets[horizon].new {
            self.renew_vertices(horizon);
        }
        self.requeue(horizon);
        let facet = &mut self.facets[horizon];
        facet.new = true;
        facet.simplicial = false;
        facet.new_merge = true;
        for &same in ring {
            self.will_delete(same, horizon);
        }
        let facet = &mut self.facets[horizon];
        if facet.vertices.len() <= KEEP_CENTER_VERTICES {
            facet.center = None;
        }
        Ok(())
    }

    /// Neighbours of the ring become neighbours of the horizon facet. Returns the visit number of the
    /// ring's facets.
    fn take_over_neighbors(&mut self, ring: &[usize], horizon: usize) -> Result<u32, Failure> {
        self.visit += 1;
        let in_ring = self.visit;
        for &same in ring {
            self.facets[same].visit = in_ring;
        }
        self.visit += 1;
        let visit = self.visit;
        self.facets[horizon].visit = visit;
        let mut neighbors = std::mem::take(&mut self.facets[horizon].neighbors);
        neighbors.retain(|&n| self.facets[n].visit != in_ring);
        for &n in &neighbors {
            self.facets[n].visit = visit;
        }
        self.facets[horizon].neighbors = neighbors;
        for &same in ring {
            for k in 0..self.facets[same].neighbors.len() {
                let n = self.facets[same].neighbors[k];
                if self.facets[n].visit == in_ring {
                    continue;
                }
                let known = self.facets[n].visit == visit;
                if !self.facets[n].simplicial {
                    remove_unordered(&mut self.facets[n].neighbors, same);
                    if !known {
                        self.facets[n].neighbors.push(horizon);
                        self.facets[horizon].neighbors.push(n);
                        self.facets[n].visit = visit;
                    }
                } else if known {
                    self.make_ridges(n);
                    remove_unordered(&mut self.facets[n].neighbors, same);
                } else {
                    self.facets[horizon].neighbors.push(n);
                    replace_item(&mut self.facets[n].neighbors, same, horizon)?;
                    self.facets[n].visit = visit;
                    let ridges = &self.facets[n].ridges;
                    let shared =
                        ridges.iter().find(|&&r| self.ridges[r].top == same || self.ridges[r].bottom == same);
                    if let Some(&r) = shared {
                        let ridge = &mut self.ridges[r];
                        *(if ridge.top == same { &mut ridge.top } else { &mut ridge.bottom }) = horizon;
                    }
                }
            }
        }
        Ok(in_ring)
    }

    /// Ridges around the ring become ridges of the horizon facet, those inside disappear.
    fn take_over_ridges(&mut self, ring: &[usize], horizon: usize, in_ring: u32) -> Result<(), Failure> {
        let mut ridges = std::mem::take(&mut self.facets[horizon].ridges);
        ridges.retain(|&r| self.facets[self.ridges[r].other(horizon)].visit != in_ring);
        self.facets[horizon].ridges = ridges;
        for &same in ring {
            for r in std::mem::take(&mut self.facets[same].ridges) {
                let ridge = &mut self.ridges[r];
                let neighbor = if ridge.top == same {
                    ridge.top = horizon;
                    ridge.bottom
                } else if ridge.bottom == same {
                    ridge.bottom = horizon;
                    ridge.top
                } else if ridge.top == horizon || ridge.bottom == horizon {
                    self.facets[horizon].ridges.push(r);
                    continue;
                } else {
                    return Err(Failure("a ridge belongs to other facets"));
                };
                if neighbor == horizon {
                    continue;
                }
                if self.facets[neighbor].visit == in_ring {
                    remove_unordered(&mut self.facets[neighbor].ridges, r);
                } else {
                    self.facets[horizon].ridges.push(r);
                }
            }
            if !self.facets[same].simplicial {
                continue;
            }
            for k in 0..self.facets[same].neighbors.len() {
                let n = self.facets[same].neighbors[k];
                if self.facets[n].visit != in_ring && self.facets[n].simplicial {
                    self.add_ridge(same, k, horizon, n, false);
                }
            }
        }
        Ok(())
    }

    /// The horizon facet replaces the ring around each vertex; vertices inside are deleted.
    fn take_over_vertices(&mut self, ring: &[usize], horizon: usize, apex: usize) {
        let in_ring = self.visit - 1;
        self.facets[horizon].visit = in_ring;
        self.vertex_visit += 1;
        let visit = self.vertex_visit;
        self.vertices[apex].visit = visit;
        let mut base = Vec::new();
        for &same in ring {
            for &v in &self.facets[same].vertices {
                if self.vertices[v].visit != visit {
                    self.vertices[v].visit = visit;
                    base.push(v);
                }
            }
        }
        base.push(apex);
        for v in base {
            self.vertices[v].lost_ridge = true;
            let mut neighbors = std::mem::take(&mut self.vertices[v].neighbors);
            neighbors.retain(|&n| self.facets[n].visit != in_ring);
            neighbors.push(horizon);
            let last = neighbors.len() < 2;
            self.vertices[v].neighbors = neighbors;
            if last {
                remove_ordered(&mut self.facets[horizon].vertices, v);
                self.mark_deleted(v);
            }
        }
    }
}
