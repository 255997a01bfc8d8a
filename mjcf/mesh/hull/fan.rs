//! The finished hull: polygons cut into triangles, in the order of the compiled arrays.

use super::failure::Failure;
use super::id::{FacetId, Id, VertexId};
use super::surface::{Side, Surface};

/// A triangulated convex hull; all indices are input points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hull {
    /// Points on the hull.
    pub vert: Vec<i32>,
    /// Hull neighbours of each entry of `vert`, as points.
    pub neighbours: Vec<Vec<i32>>,
    /// Triangles, counter-clockwise seen from outside.
    pub face: Vec<[i32; 3]>,
}

/// A triangle of the result.
#[derive(Clone, Copy)]
struct Triangle {
    /// The newest first.
    corners: [VertexId; 3],
    /// On which side of the edge between the last two corners it lies.
    side: Side,
}

impl Surface {
    /// Cuts every polygon into the triangles between its newest corner and its ridges. The triangles and
    /// vertices of polygons come after the others.
    pub(super) fn triangulated(mut self) -> Result<Hull, Failure> {
        self.keep_around();
        let facets: Vec<FacetId> = self.agenda.order().iter().collect();
        let is_triangle = |&id: &FacetId| self.facets[id].shape.is_triangle();
        let (triangles, polygons): (Vec<FacetId>, Vec<FacetId>) = facets.into_iter().partition(is_triangle);
        let mut fans = Vec::new();
        for polygon in polygons {
            self.check_boundary(polygon)?;
            self.cut(polygon, &mut fans);
        }
        let whole = triangles.iter().map(|&id| self.triangle(id));
        let triangles: Vec<Triangle> = whole.chain(fans.iter().copied()).collect();
        let point = |vertex: VertexId| self.vertices[vertex].point as i32;
        Ok(Hull {
            vert: self.vertex_order.iter().map(point).collect(),
            neighbours: self.neighbours(&fans),
            face: triangles.iter().map(|triangle| triangle.counter_clockwise().map(point)).collect(),
        })
    }

    /// Fails unless as many ridges of a polygon begin as end at each vertex, one of each.
    fn check_boundary(&self, polygon: FacetId) -> Result<(), Failure> {
        let ways = self.facets[polygon].ridges.iter().map(|&id| {
            let [newer, older] = self.ridges[id].ends;
            match self.ridges[id].side_of(polygon) {
                Side::Right => (newer, older),
                Side::Left => (older, newer),
            }
        });
        let (mut starts, mut ends): (Vec<VertexId>, Vec<VertexId>) = ways.unzip();
        starts.sort_unstable();
        ends.sort_unstable();
        if starts != ends || starts.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(Failure("the boundary of a polygon touches itself"));
        }
        Ok(())
    }

    /// Adds the triangles of a polygon, in the order of its ridges.
    fn cut(&mut self, polygon: FacetId, fans: &mut Vec<Triangle>) {
        let Some(&apex) = self.facets[polygon].corners.first() else { return };
        for k in 0..self.facets[polygon].ridges.len() {
            let ridge = self.ridges[self.facets[polygon].ridges[k]];
            let [newer, older] = ridge.ends;
            for vertex in [apex, newer, older] {
                self.freshen_vertex(vertex);
            }
            if newer != apex {
                fans.push(Triangle { corners: [apex, newer, older], side: ridge.side_of(polygon) });
            }
        }
    }

    fn triangle(&self, facet: FacetId) -> Triangle {
        let facet = &self.facets[facet];
        Triangle { corners: [facet.corners[0], facet.corners[1], facet.corners[2]], side: facet.side }
    }

    /// Neighbours of each vertex, in the order of the triangles around it.
    fn neighbours(&self, fans: &[Triangle]) -> Vec<Vec<i32>> {
        let mut slot = vec![0; self.vertex_order.iter().map(|v| v.at() + 1).max().unwrap_or(0)];
        let mut lists = Vec::with_capacity(self.vertex_order.len());
        for (k, vertex) in self.vertex_order.iter().enumerate() {
            slot[vertex.at()] = k;
            let mut list = Vec::new();
            for &facet in &self.vertices[vertex].around {
                if self.facets[facet].shape.is_triangle() {
                    self.add_others(&mut list, vertex, self.triangle(facet));
                }
            }
            lists.push(list);
        }
        for &fan in fans {
            for vertex in fan.corners {
                self.add_others(&mut lists[slot[vertex.at()]], vertex, fan);
            }
        }
        lists
    }

    fn add_others(&self, list: &mut Vec<i32>, vertex: VertexId, triangle: Triangle) {
        for corner in triangle.corners {
            let point = self.vertices[corner].point as i32;
            if corner != vertex && !list.contains(&point) {
                list.push(point);
            }
        }
    }
}

impl Triangle {
    fn counter_clockwise(self) -> [VertexId; 3] {
        let [a, b, c] = self.corners;
        if self.side == Side::Right { [b, a, c] } else { [a, b, c] }
    }
}
