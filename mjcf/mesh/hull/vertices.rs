//! Vertices that merging has made redundant: they are no corner of a merged facet any more, or have only
//! two facets around them, and their ridges go to another vertex.

use super::Failure;
use super::polytope::{NONE, Polytope, TAIL, remove_ordered, remove_unordered};

impl Polytope<'_> {
    /// Removes redundant vertices of merged facets; whether facets became degenerate and were merged.
    pub(super) fn reduce_vertices(&mut self) -> Result<bool, Failure> {
        let mut merged = self.merge_degenerate()? > 0;
        'restart: loop {
            let mut facet = self.first_new;
            while facet != NONE && facet != TAIL {
                if self.facets[facet].new_merge && self.remove_extra_vertices(facet) {
                    self.queue_if_degenerate_or_redundant(facet);
                    if self.merge_degenerate()? > 0 {
                        merged = true;
                        continue 'restart;
                    }
                }
                facet = self.facets[facet].next;
            }
            let mut facet = self.first_new;
            while facet != NONE && facet != TAIL {
                if self.facets[facet].new_merge {
                    self.facets[facet].new_merge = false;
                    let mut k = 0;
                    while k < self.facets[facet].vertices.len() {
                        let v = self.facets[facet].vertices[k];
                        if !self.vertices[v].lost_ridge || !self.rename_shared_vertex(v, facet) {
                            k += 1;
                            continue;
                        }
                        if self.merge_degenerate()? > 0 {
                            merged = true;
                            continue 'restart;
                        }
                    }
                }
                facet = self.facets[facet].next;
            }
            break;
        }
        for v in self.vertices_from(self.first_new_vertex) {
            if !self.vertices[v].deleted {
                self.vertices[v].lost_ridge = false;
            }
        }
        Ok(merged)
    }

    /// Removes vertices that no ridge of the facet has.
    fn remove_extra_vertices(&mut self, facet: usize) -> bool {
        if self.facets[facet].simplicial {
            return false;
        }
        for k in 0..self.facets[facet].vertices.len() {
            let v = self.facets[facet].vertices[k];
            self.vertices[v].seen = false;
        }
        for k in 0..self.facets[facet].ridges.len() {
            for v in self.ridges[self.facets[facet].ridges[k]].vertices {
                self.vertices[v].seen = true;
            }
        }
        let mut removed = false;
        let mut k = 0;
        while let Some(&v) = self.facets[facet].vertices.get(k) {
            if self.vertices[v].seen {
                k += 1;
                continue;
            }
            removed = true;
            self.facets[facet].vertices.remove(k);
            remove_unordered(&mut self.vertices[v].neighbors, facet);
            if self.vertices[v].neighbors.is_empty() {
                self.mark_deleted(v);
                // The vertex that moved up is kept even if it is extra, as Qhull does.
                k += 1;
            }
        }
        removed
    }

    /// Replaces a vertex between only two facets by the neighbour along their common border.
    fn rename_shared_vertex(&mut self, vertex: usize, facet: usize) -> bool {
        let &[a, b] = self.vertices[vertex].neighbors.as_slice() else { return false };
        let other = if a == facet { b } else { a };
        self.visit += 1;
        self.facets[other].visit = self.visit;
        let mut ridges = Vec::new();
        self.collect_ridges(vertex, facet, &mut ridges);
        let theirs = &self.facets[other].vertices;
        let mut candidates: Vec<usize> =
            self.facets[facet].vertices.iter().copied().filter(|v| theirs.contains(v)).collect();
        remove_unordered(&mut candidates, vertex);
        let Some(new) = self.choose_replacement(vertex, candidates, &ridges) else { return false };
        self.rename_vertex(vertex, new, &ridges, facet);
        true
    }

    /// Ridges of `facet` at a vertex towards facets of the current visit; `facet` then leaves the visit.
    fn collect_ridges(&mut self, vertex: usize, facet: usize, ridges: &mut Vec<usize>) {
        for &r in &self.facets[facet].ridges {
            let ridge = &self.ridges[r];
            if self.facets[ridge.other(facet)].visit == self.visit && ridge.vertices.contains(&vertex) {
                ridges.push(r);
            }
        }
        self.facets[facet].visit = self.visit - 1;
    }

    /// The first candidate on the ridges whose own ridges would not collide with the renamed ones.
    fn choose_replacement(&mut self, old: usize, candidates: Vec<usize>, ridges: &[usize]) -> Option<usize> {
        let on_ridges =
            |v: usize| ridges.iter().filter(|&&r| self.ridges[r].vertices.contains(&v)).count() as u32;
        let mut ranked: Vec<(u32, usize)> = Vec::new();
        let mut rest = candidates;
        let mut k = 0;
        while k < rest.len() {
            if on_ridges(rest[k]) == 0 {
                rest.swap_remove(k);
            } else {
                k += 1;
            }
        }
        ranked.extend(rest.iter().map(|&v| (on_ridges(v), v)));
        ranked.sort_by_key(|&(count, _)| count);
        let beyond = |pair: [usize; 2], v: usize| if pair[0] == v { pair[1] } else { pair[0] };
        ranked.into_iter().map(|(_, v)| v).find(|&v| {
            let own = self.ridges_around(v);
            !own.iter().any(|&r| {
                let end = beyond(self.ridges[r].vertices, v);
                ridges.iter().any(|&s| s != r && beyond(self.ridges[s].vertices, old) == end)
            })
        })
    }

    /// Ridges between the facets around a vertex.
    fn ridges_around(&mut self, vertex: usize) -> Vec<usize> {
        self.visit += 2;
        let neighbors = self.vertices[vertex].neighbors.clone();
        for &n in &neighbors {
            self.facets[n].visit = self.visit;
        }
        let mut ridges = Vec::new();
        for &n in neighbors.iter().take(neighbors.len().saturating_sub(1)) {
            self.collect_ridges(vertex, n, &mut ridges);
        }
        ridges
    }

    fn rename_vertex(&mut self, old: usize, new: usize, ridges: &[usize], facet: usize) {
        for &r in ridges {
            self.rename_in_ridge(r, old, new);
        }
        for n in self.vertices[old].neighbors.clone() {
            remove_ordered(&mut self.facets[n].vertices, old);
            self.queue_if_degenerate_or_redundant(n);
        }
        self.mark_deleted(old);
        self.queue_if_degenerate_or_redundant(facet);
    }

    /// Replaces a vertex of a ridge, keeping its orientation; a ridge with one end is deleted.
    fn rename_in_ridge(&mut self, id: usize, old: usize, new: usize) {
        let ridge = self.ridges[id];
        let [a, b] = ridge.vertices;
        let (old_at, kept) = if a == old { (0, b) } else { (1, a) };
        if kept == new {
            // Only the remaining end is marked as having lost a ridge.
            self.ridges[id].vertices = [kept, kept];
            self.delete_ridge(id);
            return;
        }
        let new_at = usize::from(kept > new);
        let ridge = &mut self.ridges[id];
        ridge.vertices = if new_at == 0 { [new, kept] } else { [kept, new] };
        ridge.simplicial_top = false;
        ridge.simplicial_bottom = false;
        if old_at != new_at {
            std::mem::swap(&mut ridge.top, &mut ridge.bottom);
        }
    }
}
