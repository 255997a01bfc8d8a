//! The growing polytope: facets, vertices and ridges in slots, and the ordered lists that thread them.
//!
//! Facets form one list. The facets under construction are its tail from `first_new` on; facets a new
//! point sees, and facets merged away, precede them from `first_visible` on until they are deleted.

use super::Failure;
use super::simplex::Tolerances;
use crate::vector::dot;

pub(super) const NONE: usize = usize::MAX;
/// Slot of the sentinel that ends the facet list and the vertex list.
pub(super) const TAIL: usize = 0;

/// A planar face. `vertices` are in decreasing order of slot serial; while the facet is simplicial,
/// `neighbors[k]` lies opposite `vertices[k]`.
#[derive(Debug, Clone, Default)]
pub(super) struct Facet {
    pub vertices: Vec<usize>,
    pub neighbors: Vec<usize>,
    /// Borders with neighbours, as far as either side is not simplicial.
    pub ridges: Vec<usize>,
    /// Whether the facet ever had a ridge.
    pub ridged: bool,
    /// Outward unit normal, once computed.
    pub normal: Option<[f64; 3]>,
    pub offset: f64,
    /// Mean of the vertices projected onto the plane.
    pub center: Option<[f64; 3]>,
    /// Points above, the farthest last.
    pub outside: Vec<usize>,
    pub furthest: f64,
    pub not_furthest: bool,
    /// Points within round-off, the farthest last.
    pub coplanar: Vec<usize>,
    /// Whether the order of `vertices` is clockwise seen from outside.
    pub top_oriented: bool,
    pub simplicial: bool,
    pub flipped: bool,
    /// Seen by the new point or merged away.
    pub visible: bool,
    pub new: bool,
    pub new_merge: bool,
    pub tested: bool,
    /// The new point is within round-off of the plane of this horizon facet.
    pub coplanar_horizon: bool,
    /// New facet to be merged with its coplanar horizon.
    pub merge_horizon: bool,
    pub cycle_done: bool,
    pub degenerate: bool,
    pub redundant: bool,
    pub keep_center: bool,
    pub seen: bool,
    pub visit: u32,
    /// Facet that takes over the points of a visible one.
    pub replace: usize,
    /// Ring of new facets with the same coplanar horizon.
    pub same_cycle: usize,
    /// Latest ring of a coplanar horizon facet.
    pub new_cycle: usize,
    pub prev: usize,
    pub next: usize,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Vertex {
    pub point: usize,
    /// Facets around the vertex; maintained from the first merge on.
    pub neighbors: Vec<usize>,
    pub new: bool,
    /// A ridge of the vertex was deleted, so it may be redundant.
    pub lost_ridge: bool,
    pub deleted: bool,
    pub partitioned: bool,
    pub seen: bool,
    pub visit: u32,
    pub prev: usize,
    pub next: usize,
}

/// Border between two facets: its vertices are counter-clockwise for `top`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ridge {
    pub vertices: [usize; 2],
    pub top: usize,
    pub bottom: usize,
    pub tested: bool,
    pub nonconvex: bool,
    pub simplicial_top: bool,
    pub simplicial_bottom: bool,
}

impl Ridge {
    pub(super) fn other(&self, facet: usize) -> usize {
        if self.top == facet { self.bottom } else { self.top }
    }
}

pub(super) struct Polytope<'a> {
    pub points: &'a [[f64; 3]],
    pub tol: Tolerances,
    pub interior: [f64; 3],
    pub facets: Vec<Facet>,
    free_facets: Vec<usize>,
    pub vertices: Vec<Vertex>,
    pub ridges: Vec<Ridge>,
    pub first_facet: usize,
    pub first_new: usize,
    pub first_visible: usize,
    /// Next facet to take an outside point from.
    pub next_facet: usize,
    pub first_vertex: usize,
    pub first_new_vertex: usize,
    pub deleted_vertices: Vec<usize>,
    pub facet_count: usize,
    pub visible_count: usize,
    pub vertex_count: usize,
    pub visit: u32,
    pub vertex_visit: u32,
    /// Whether `Vertex::neighbors` is maintained.
    pub has_vertex_neighbors: bool,
    pub merge_count: usize,
    /// Largest distance of a point above the facet it belongs to.
    pub max_outside: f64,
    /// Limit on that distance before a point counts as outside again.
    pub outside_limit: f64,
    /// Search all new facets instead of walking from one.
    pub search_new: bool,
    pub new_not_sharp: bool,
    /// The initial simplex is so flat that points near a facet count as outside.
    pub narrow: bool,
    pub merges: Vec<super::merge::Merge>,
    pub degenerate_merges: Vec<super::merge::Merge>,
    pub search_stack: Vec<usize>,
}

impl<'a> Polytope<'a> {
    /// Empty lists, each with its sentinel.
    pub(super) fn empty(points: &'a [[f64; 3]], tol: Tolerances) -> Self {
        let tail = Facet { new: true, prev: NONE, next: NONE, replace: NONE, ..Facet::default() };
        let vertex_tail = Vertex { point: NONE, prev: NONE, next: NONE, ..Vertex::default() };
        Self {
            points,
            tol,
            interior: [0.0; 3],
            facets: vec![tail],
            free_facets: Vec::new(),
            vertices: vec![vertex_tail],
            ridges: Vec::new(),
            first_facet: TAIL,
            first_new: TAIL,
            first_visible: NONE,
            next_facet: NONE,
            first_vertex: TAIL,
            first_new_vertex: TAIL,
            deleted_vertices: Vec::new(),
            facet_count: 0,
            visible_count: 0,
            vertex_count: 0,
            visit: 0,
            vertex_visit: 0,
            has_vertex_neighbors: false,
            merge_count: 0,
            max_outside: 0.0,
            outside_limit: 0.0,
            search_new: false,
            new_not_sharp: false,
            narrow: false,
            merges: Vec::new(),
            degenerate_merges: Vec::new(),
            search_stack: Vec::new(),
        }
    }

    pub(super) fn point(&self, vertex: usize) -> [f64; 3] {
        self.points[self.vertices[vertex].point]
    }

    /// Signed distance of a point above the plane of a facet.
    pub(super) fn distance(&self, point: [f64; 3], facet: usize) -> f64 {
        let f = &self.facets[facet];
        let n = f.normal.unwrap_or_default();
        f.offset + point[0] * n[0] + point[1] * n[1] + point[2] * n[2]
    }

    /// Facets from `start` to the end of the list.
    pub(super) fn facets_from(&self, start: usize) -> Vec<usize> {
        let mut list = Vec::new();
        let mut at = start;
        while at != NONE && at != TAIL {
            list.push(at);
            at = self.facets[at].next;
        }
        list
    }

    /// A new simplicial facet at the end of the list.
    pub(super) fn new_facet(&mut self, vertices: [usize; 3], top_oriented: bool, horizon: usize) -> usize {
        for v in vertices {
            if !self.vertices[v].new {
                self.remove_vertex(v);
                self.append_vertex(v);
            }
        }
        let slot = self.free_facets.pop().unwrap_or_else(|| {
            self.facets.push(Facet::default());
            self.facets.len() - 1
        });
        let facet = &mut self.facets[slot];
        facet.vertices.extend(vertices);
        facet.top_oriented = top_oriented;
        facet.simplicial = true;
        facet.new = true;
        (facet.replace, facet.same_cycle, facet.new_cycle) = (NONE, NONE, NONE);
        if horizon != NONE {
            facet.neighbors.push(horizon);
        }
        self.append_facet(slot);
        slot
    }

    pub(super) fn append_facet(&mut self, facet: usize) {
        if self.first_new == TAIL {
            self.first_new = facet;
            if self.first_visible == TAIL {
                self.first_visible = facet;
            }
        }
        if self.next_facet == TAIL {
            self.next_facet = facet;
        }
        self.insert_facet(facet, TAIL);
    }

    /// Puts a facet in front of the visible ones and makes it the first of them.
    fn prepend_visible(&mut self, facet: usize) {
        let before = if self.first_visible == NONE { TAIL } else { self.first_visible };
        if self.next_facet == before {
            self.next_facet = facet;
        }
        self.insert_facet(facet, before);
        self.first_visible = facet;
    }

    /// Moves a facet to where the next outside point is taken from.
    pub(super) fn process_next(&mut self, facet: usize) {
        self.remove_facet(facet);
        let before = self.next_facet;
        self.insert_facet(facet, before);
        self.next_facet = facet;
    }

    fn insert_facet(&mut self, facet: usize, before: usize) {
        let prev = self.facets[before].prev;
        self.facets[facet].prev = prev;
        self.facets[facet].next = before;
        self.facets[before].prev = facet;
        if prev == NONE {
            self.first_facet = facet;
        } else {
            self.facets[prev].next = facet;
        }
        self.facet_count += 1;
    }

    pub(super) fn remove_facet(&mut self, facet: usize) {
        let Facet { prev, next, .. } = self.facets[facet];
        for start in [&mut self.first_new, &mut self.next_facet, &mut self.first_visible] {
            if *start == facet {
                *start = next;
            }
        }
        self.facets[next].prev = prev;
        if prev == NONE {
            self.first_facet = next;
        } else {
            self.facets[prev].next = next;
        }
        self.facet_count -= 1;
    }

    /// Moves a facet to the end of the list.
    pub(super) fn requeue(&mut self, facet: usize) {
        self.remove_facet(facet);
        self.append_facet(facet);
    }

    /// Takes a facet off the list and frees its slot.
    pub(super) fn delete_facet(&mut self, facet: usize) {
        self.remove_facet(facet);
        let old = std::mem::take(&mut self.facets[facet]);
        let keep = &mut self.facets[facet];
        (keep.vertices, keep.neighbors, keep.ridges) = (old.vertices, old.neighbors, old.ridges);
        (keep.outside, keep.coplanar) = (old.outside, old.coplanar);
        for list in [&mut keep.vertices, &mut keep.neighbors, &mut keep.ridges, &mut keep.outside] {
            list.clear();
        }
        keep.coplanar.clear();
        self.free_facets.push(facet);
    }

    /// Marks a facet merged into `replace` for deletion.
    pub(super) fn will_delete(&mut self, facet: usize, replace: usize) {
        self.remove_facet(facet);
        self.prepend_visible(facet);
        self.visible_count += 1;
        let f = &mut self.facets[facet];
        f.visible = true;
        f.replace = replace;
        f.ridges.clear();
        f.neighbors.clear();
    }

    /// The facet that took over from a visible one, `NONE` if there is none.
    pub(super) fn replacement(&self, facet: usize) -> usize {
        let mut at = facet;
        while at != NONE && self.facets[at].visible {
            at = self.facets[at].replace;
        }
        at
    }

    pub(super) fn new_vertex(&mut self, point: usize) -> usize {
        self.vertices.push(Vertex { point, prev: NONE, next: NONE, ..Vertex::default() });
        self.vertices.len() - 1
    }

    pub(super) fn append_vertex(&mut self, vertex: usize) {
        if self.first_new_vertex == TAIL {
            self.first_new_vertex = vertex;
        }
        let prev = self.vertices[TAIL].prev;
        let v = &mut self.vertices[vertex];
        v.new = true;
        (v.prev, v.next) = (prev, TAIL);
        self.vertices[TAIL].prev = vertex;
        if prev == NONE {
            self.first_vertex = vertex;
        } else {
            self.vertices[prev].next = vertex;
        }
        self.vertex_count += 1;
    }

    pub(super) fn remove_vertex(&mut self, vertex: usize) {
        let Vertex { prev, next, .. } = self.vertices[vertex];
        if self.first_new_vertex == vertex {
            self.first_new_vertex = next;
        }
        self.vertices[next].prev = prev;
        if prev == NONE {
            self.first_vertex = next;
        } else {
            self.vertices[prev].next = next;
        }
        self.vertex_count -= 1;
    }

    /// Moves the vertices that are not new to the end of the vertex list.
    pub(super) fn renew_vertices(&mut self, facet: usize) {
        for k in 0..self.facets[facet].vertices.len() {
            let v = self.facets[facet].vertices[k];
            if !self.vertices[v].new {
                self.remove_vertex(v);
                self.append_vertex(v);
            }
        }
    }

    pub(super) fn vertices_from(&self, start: usize) -> Vec<usize> {
        let mut list = Vec::new();
        let mut at = start;
        while at != NONE && at != TAIL {
            list.push(at);
            at = self.vertices[at].next;
        }
        list
    }

    pub(super) fn mark_deleted(&mut self, vertex: usize) {
        self.vertices[vertex].deleted = true;
        self.deleted_vertices.push(vertex);
    }

    /// Deletes visible facets and the vertices that were only theirs.
    pub(super) fn delete_visible(&mut self) {
        let mut at = self.first_visible;
        while at != NONE && at != TAIL && self.facets[at].visible {
            let next = self.facets[at].next;
            self.delete_facet(at);
            at = next;
        }
        self.visible_count = 0;
        for v in std::mem::take(&mut self.deleted_vertices) {
            self.remove_vertex(v);
        }
    }

    /// Ends the construction of a cone: nothing is new or visible any more.
    pub(super) fn settle(&mut self) {
        for v in self.vertices_from(self.first_new_vertex) {
            self.vertices[v].new = false;
        }
        for f in self.facets_from(self.first_new) {
            self.facets[f].new = false;
        }
        self.first_new_vertex = NONE;
        self.first_new = NONE;
        self.first_visible = NONE;
    }

    /// Ridges of a simplicial facet, which thereby stops being treated as simplicial.
    pub(super) fn make_ridges(&mut self, facet: usize) {
        if !self.facets[facet].simplicial {
            return;
        }
        self.facets[facet].simplicial = false;
        let neighbors = self.facets[facet].neighbors.clone();
        for &n in &neighbors {
            self.facets[n].seen = false;
        }
        for k in 0..self.facets[facet].ridges.len() {
            let other = self.ridges[self.facets[facet].ridges[k]].other(facet);
            self.facets[other].seen = true;
        }
        for (k, &n) in neighbors.iter().enumerate() {
            if self.facets[n].seen {
                continue;
            }
            let tested = self.facets[facet].tested;
            self.add_ridge(facet, k, facet, n, tested);
        }
    }

    /// Ridge opposite the `skip`-th vertex of the simplicial facet `of`, between `owner` (which is `of`
    /// or replaces it) and `neighbor`.
    pub(super) fn add_ridge(&mut self, of: usize, skip: usize, owner: usize, neighbor: usize, tested: bool) {
        let v = &self.facets[of].vertices;
        let vertices = match skip {
            0 => [v[1], v[2]],
            1 => [v[0], v[2]],
            _ => [v[0], v[1]],
        };
        let owner_on_top = self.facets[of].top_oriented ^ (skip % 2 == 1);
        let owner_simplicial = owner == of;
        let neighbor_simplicial = self.facets[neighbor].simplicial;
        let ridge = if owner_on_top {
            Ridge {
                vertices,
                top: owner,
                bottom: neighbor,
                tested,
                nonconvex: false,
                simplicial_top: owner_simplicial,
                simplicial_bottom: neighbor_simplicial,
            }
        } else {
            Ridge {
                vertices,
                top: neighbor,
                bottom: owner,
                tested,
                nonconvex: false,
                simplicial_top: neighbor_simplicial,
                simplicial_bottom: owner_simplicial,
            }
        };
        self.ridges.push(ridge);
        let id = self.ridges.len() - 1;
        for facet in [owner, neighbor] {
            self.facets[facet].ridges.push(id);
            self.facets[facet].ridged = true;
        }
    }

    /// Fills `Vertex::neighbors` from the facets.
    pub(super) fn ensure_vertex_neighbors(&mut self) {
        if self.has_vertex_neighbors {
            return;
        }
        for f in self.facets_from(self.first_facet) {
            if self.facets[f].visible {
                continue;
            }
            for k in 0..self.facets[f].vertices.len() {
                let v = self.facets[f].vertices[k];
                self.vertices[v].neighbors.push(f);
            }
        }
        self.has_vertex_neighbors = true;
    }

    /// Marks `facet`'s vertices with a fresh visit number and returns it.
    pub(super) fn visit_vertices(&mut self, facet: usize) -> u32 {
        self.vertex_visit += 1;
        for k in 0..self.facets[facet].vertices.len() {
            let v = self.facets[facet].vertices[k];
            self.vertices[v].visit = self.vertex_visit;
        }
        self.vertex_visit
    }

    /// Cosine of the angle between two facets' normals.
    pub(super) fn cosine(&self, a: usize, b: usize) -> f64 {
        dot(self.facets[a].normal.unwrap_or_default(), self.facets[b].normal.unwrap_or_default())
    }

    /// Adds points until none is outside, or `limit` vertices are reached.
    pub(super) fn grow(&mut self, limit: Option<usize>) -> Result<(), Failure> {
        self.next_facet = self.first_facet;
        // A point that merging takes from the hull may come again, but not for ever.
        let mut room = 4 * self.points.len() + 100;
        while let Some((point, facet)) = self.next_outside(limit.is_some()) {
            room = room.checked_sub(1).ok_or(Failure("points leave the hull and come again"))?;
            if limit.is_some_and(|limit| self.vertex_count >= limit) {
                break;
            }
            self.add_point(point, facet)?;
        }
        Ok(())
    }
}

/// Removes `item`; the last element takes its place.
pub(super) fn remove_unordered(list: &mut Vec<usize>, item: usize) {
    if let Some(at) = list.iter().position(|&x| x == item) {
        list.swap_remove(at);
    }
}

/// Removes `item`, keeping the order of the others.
pub(super) fn remove_ordered(list: &mut Vec<usize>, item: usize) {
    if let Some(at) = list.iter().position(|&x| x == item) {
        list.remove(at);
    }
}

/// Puts `new` where `old` is.
pub(super) fn replace_item(list: &mut [usize], old: usize, new: usize) -> Result<(), Failure> {
    let slot =
        list.iter_mut().find(|x| **x == old).ok_or(Failure("facets disagree about being neighbours"))?;
    *slot = new;
    Ok(())
}

/// Appends a point that is not the farthest.
pub(super) fn push_before_last(list: &mut Vec<usize>, item: usize) {
    let at = list.len().saturating_sub(1);
    list.insert(at, item);
}
