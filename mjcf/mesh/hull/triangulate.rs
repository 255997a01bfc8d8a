//! Cutting merged facets into triangles, and reading off the finished hull.

use super::polytope::{NONE, Polytope, TAIL, replace_item};
use super::{Failure, Hull};

impl Polytope<'_> {
    /// Replaces each polygon by a fan of triangles from its latest vertex.
    pub(super) fn triangulate(&mut self) -> Result<(), Failure> {
        self.visit += 1;
        self.first_new_vertex = TAIL;
        let mut first_vertex = NONE;
        let mut first_triangulated = NONE;
        let mut facet = self.first_facet;
        while facet != TAIL {
            let next = self.facets[facet].next;
            if !self.facets[facet].visible && !self.facets[facet].simplicial {
                let fan = self.cut(facet, &mut first_vertex)?;
                if first_triangulated == NONE {
                    first_triangulated = fan;
                }
            }
            facet = next;
        }
        if first_triangulated == NONE {
            return Ok(());
        }
        for f in self.facets_from(first_triangulated) {
            let facet = &mut self.facets[f];
            if facet.visible {
                continue;
            }
            facet.ridges.clear();
            if facet.vertices[0] == facet.vertices[1] {
                self.collapse(f)?;
            }
        }
        for v in self.vertices_from(first_vertex) {
            let mut neighbors = std::mem::take(&mut self.vertices[v].neighbors);
            neighbors.retain(|&n| !self.facets[n].visible);
            self.vertices[v].neighbors = neighbors;
        }
        Ok(())
    }

    /// Fan of one facet: a triangle over each ridge, also the two at the apex, which are flat. Returns
    /// the first of them.
    fn cut(&mut self, facet: usize, first_vertex: &mut usize) -> Result<usize, Failure> {
        for k in 0..self.facets[facet].neighbors.len() {
            let n = self.facets[facet].neighbors[k];
            self.facets[n].seen = false;
            self.facets[n].coplanar_horizon = false;
        }
        self.first_visible = TAIL;
        self.first_new = TAIL;
        let apex = self.facets[facet].vertices[0];
        self.cone_from_ridges(facet, apex)?;
        let first = self.first_new;
        self.will_delete(facet, NONE);
        self.match_new_facets()?;
        if *first_vertex == NONE {
            *first_vertex = self.first_new_vertex;
        }
        self.first_new_vertex = NONE;
        for f in self.facets_from(first) {
            for k in 0..3 {
                let v = self.facets[f].vertices[k];
                self.vertices[v].neighbors.push(f);
            }
            self.facets[f].new = false;
        }
        self.first_new = NONE;
        self.first_visible = NONE;
        Ok(first)
    }

    /// Removes a flat triangle by making the facets on its two sides neighbours.
    fn collapse(&mut self, facet: usize) -> Result<(), Failure> {
        let [a, b] = [self.facets[facet].neighbors[0], self.facets[facet].neighbors[1]];
        if self.facets[a].neighbors.contains(&b) {
            return Err(Failure("two triangles share all vertices"));
        }
        replace_item(&mut self.facets[b].neighbors, facet, a)?;
        replace_item(&mut self.facets[a].neighbors, facet, b)?;
        self.will_delete(facet, NONE);
        Ok(())
    }

    /// The hull in list order.
    pub(super) fn export(mut self) -> Hull {
        self.ensure_vertex_neighbors();
        let facets: Vec<usize> =
            self.facets_from(self.first_facet).into_iter().filter(|&f| !self.facets[f].visible).collect();
        let id = |v: usize| self.vertices[v].point as i32;
        let face = facets.iter().map(|&f| {
            let [a, b, c] = std::array::from_fn(|k| id(self.facets[f].vertices[k]));
            if self.facets[f].top_oriented { [b, a, c] } else { [a, b, c] }
        });
        let order = self.vertices_from(self.first_vertex);
        let neighbours = order.iter().map(|&v| {
            let mut around: Vec<i32> = Vec::new();
            for &f in &self.vertices[v].neighbors {
                for &w in &self.facets[f].vertices {
                    if w != v && !around.contains(&id(w)) {
                        around.push(id(w));
                    }
                }
            }
            around
        });
        Hull {
            vert: order.iter().map(|&v| id(v)).collect(),
            neighbours: neighbours.collect(),
            face: face.collect(),
        }
    }
}
