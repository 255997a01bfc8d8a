//! The surface of the growing hull: facets, ridges and vertices, and who borders on whom.
//!
//! Most facets are triangles that touch triangles, and for those the list of neighbours says everything. A
//! ridge is kept only where one side is a polygon.

use super::failure::Failure;
use super::id::{FacetId, Marks, RidgeId, Table, VertexId};
use super::plane::Plane;
use super::sequence::{Agenda, Sequence};

/// What a facet's lists mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Shape {
    /// `neighbors[k]` lies opposite `corners[k]`; there never was a ridge.
    #[default]
    Triangle,
    /// The same, with ridges towards the neighbours that are polygons.
    RidgedTriangle,
    /// Every neighbour is listed once and every part of the boundary is a ridge.
    Polygon,
}

impl Shape {
    pub(super) fn is_triangle(self) -> bool {
        self != Self::Polygon
    }
}

/// Where an item is in the construction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Phase {
    /// On the hull, untouched by the current step.
    #[default]
    Settled,
    /// On the hull, made or changed by the current step.
    Fresh,
    /// No part of the hull any more. A facet's points go to its heir, or to any fresh facet without one.
    Removed { heir: Option<FacetId> },
}

impl Phase {
    pub(super) fn is_removed(self) -> bool {
        matches!(self, Self::Removed { .. })
    }
}

/// A side of the way from the newer to the older end of an edge, seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Side {
    #[default]
    Right,
    Left,
}

impl Side {
    pub(super) fn opposite(self) -> Self {
        match self {
            Self::Right => Self::Left,
            Self::Left => Self::Right,
        }
    }
}

/// A planar face.
#[derive(Debug, Default)]
pub(super) struct Facet {
    /// Vertices, the newest first.
    pub corners: Vec<VertexId>,
    pub neighbors: Vec<FacetId>,
    pub ridges: Vec<RidgeId>,
    pub shape: Shape,
    /// Of a triangle: on which side of the edge between its two oldest corners it lies.
    pub side: Side,
    pub phase: Phase,
    pub plane: Plane,
    /// The plane has the interior point above it, or within round-off.
    pub inverted: bool,
    /// Mean of the corners projected onto the plane, once needed.
    pub center: Option<[f64; 3]>,
    /// The centre stays although corners come and go.
    pub pinned: bool,
    /// Convexity to all neighbours has been tested since the last change.
    pub tested: bool,
    /// Points to be added, the highest last.
    pub outside: Vec<usize>,
    /// Height of the last of them.
    pub reach: f64,
    /// Points within round-off, the highest last.
    pub near: Vec<usize>,
}

impl Facet {
    /// Whether it has too few neighbours to enclose an area.
    pub(super) fn is_thin(&self) -> bool {
        self.neighbors.len() < 3
    }

    /// Whether all corners of `other` are corners of this one. Both lists have the newest first, so that one pass over this
    /// one's meets the other's in their order.
    pub(super) fn covers(&self, other: &Facet) -> bool {
        let mut own = self.corners.iter();
        other.corners.iter().all(|corner| own.any(|mine| mine == corner))
    }

    /// On which side of the edge between the corners other than `corners[k]` a triangle lies.
    pub(super) fn side_opposite(&self, k: usize) -> Side {
        if k == 1 { self.side.opposite() } else { self.side }
    }

    /// The corners of a triangle other than `corners[k]`, the newer first.
    pub(super) fn edge_opposite(&self, k: usize) -> [VertexId; 2] {
        let c = &self.corners;
        [[c[1], c[2]], [c[0], c[2]], [c[0], c[1]]][k]
    }
}

#[derive(Debug)]
pub(super) struct Vertex {
    /// Input point.
    pub point: usize,
    pub phase: Phase,
    /// Facets at the vertex, while `Surface` keeps account of them.
    pub around: Vec<FacetId>,
    /// A ridge of the vertex has disappeared, so it may lie inside an edge.
    pub loose: bool,
}

/// What is known of the angle between the facets at a ridge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Convexity {
    Unknown,
    Convex,
    Nonconvex,
}

/// Border between two facets; at least one is or was a polygon.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ridge {
    /// The newer vertex first.
    pub ends: [VertexId; 2],
    /// Facets on the right and on the left.
    pub sides: [FacetId; 2],
    pub convexity: Convexity,
}

impl Ridge {
    pub(super) fn beyond(&self, facet: FacetId) -> FacetId {
        if self.sides[0] == facet { self.sides[1] } else { self.sides[0] }
    }

    pub(super) fn borders(&self, facet: FacetId) -> bool {
        self.sides.contains(&facet)
    }

    pub(super) fn side_of(&self, facet: FacetId) -> Side {
        if self.sides[0] == facet { Side::Right } else { Side::Left }
    }

    /// Gives the side of one facet to another.
    pub(super) fn hand_over(&mut self, from: FacetId, to: FacetId) {
        self.sides[self.side_of(from) as usize] = to;
    }
}

#[derive(Debug, Default)]
pub(super) struct Surface {
    pub facets: Table<FacetId, Facet>,
    pub vertices: Table<VertexId, Vertex>,
    pub ridges: Table<RidgeId, Ridge>,
    pub agenda: Agenda,
    pub vertex_order: Sequence<VertexId>,
    /// Facets below the point of the current step.
    pub hidden: Vec<FacetId>,
    /// Facets united into others in the current step.
    pub absorbed: Vec<FacetId>,
    /// Vertices that ceased to be one in the current step.
    pub lost: Vec<VertexId>,
    /// Whether `Vertex::around` is kept: from the first union on.
    pub keeps_around: bool,
    /// Facets passed by the current walk.
    pub passed: Marks<FacetId>,
    /// Vertices of the facet under consideration.
    pub own: Marks<VertexId>,
    /// While a cone closes, per vertex of the horizon: the triangles that end and begin there, and where
    /// their lists of neighbours have room for each other.
    pub joints: Table<VertexId, [Option<(FacetId, usize)>; 2]>,
    spare: Vec<FacetId>,
}

impl Surface {
    pub(super) fn add_vertex(&mut self, point: usize) -> VertexId {
        let id = self.vertices.push(Vertex { point, phase: Phase::Fresh, around: Vec::new(), loose: false });
        self.vertex_order.push(id);
        self.joints.push([None; 2]);
        id
    }

    /// Moves a settled vertex to the end of the order: vertices come in the order of the steps that last
    /// changed their facets.
    pub(super) fn freshen_vertex(&mut self, vertex: VertexId) {
        if self.vertices[vertex].phase == Phase::Settled {
            self.vertices[vertex].phase = Phase::Fresh;
            self.vertex_order.remove(vertex);
            self.vertex_order.push(vertex);
        }
    }

    /// Makes a vertex disappear with the current step.
    pub(super) fn lose_vertex(&mut self, vertex: VertexId) {
        self.vertices[vertex].phase = Phase::Removed { heir: None };
        self.lost.push(vertex);
    }

    /// A fresh triangle without neighbours. Its corners are given the newest first.
    pub(super) fn add_triangle(&mut self, corners: [VertexId; 3], side: Side) -> FacetId {
        for corner in corners {
            self.freshen_vertex(corner);
        }
        let id = self.spare.pop().unwrap_or_else(|| self.facets.push(Facet::default()));
        let facet = &mut self.facets[id];
        facet.corners.extend(corners);
        facet.side = side;
        facet.phase = Phase::Fresh;
        self.agenda.push(id);
        id
    }

    /// Moves a facet to the end of the order, as a fresh one.
    pub(super) fn freshen_facet(&mut self, facet: FacetId) {
        self.agenda.remove(facet);
        self.agenda.push(facet);
        self.facets[facet].phase = Phase::Fresh;
    }

    /// Takes a facet off the hull because the new point is above it.
    pub(super) fn hide(&mut self, facet: FacetId) {
        self.agenda.remove(facet);
        self.facets[facet].phase = Phase::Removed { heir: None };
        self.hidden.push(facet);
    }

    /// Takes a facet off the hull that has been united into `heir`.
    pub(super) fn retire(&mut self, facet: FacetId, heir: FacetId) {
        self.agenda.remove(facet);
        self.facets[facet].phase = Phase::Removed { heir: Some(heir) };
        self.absorbed.push(facet);
    }

    /// The facet on the hull that took over from `facet`, possibly over several unions.
    pub(super) fn heir(&self, facet: FacetId) -> Option<FacetId> {
        let mut at = facet;
        while let Phase::Removed { heir } = self.facets[at].phase {
            at = heir?;
        }
        Some(at)
    }

    /// Ends a step: what is removed goes, what is fresh settles.
    pub(super) fn finish_step(&mut self) {
        for id in self.absorbed.drain(..).chain(self.hidden.drain(..)) {
            let mut facet = std::mem::take(&mut self.facets[id]);
            facet.corners.clear();
            facet.neighbors.clear();
            facet.ridges.clear();
            facet.outside.clear();
            facet.near.clear();
            // The lists keep their memory for the next triangle.
            let Facet { corners, neighbors, ridges, outside, near, .. } = facet;
            let phase = Phase::Removed { heir: None };
            self.facets[id] = Facet { corners, neighbors, ridges, outside, near, phase, ..Facet::default() };
            self.spare.push(id);
        }
        for vertex in self.lost.drain(..) {
            self.vertex_order.remove(vertex);
        }
        for vertex in self.vertex_order.fresh() {
            self.vertices[vertex].phase = Phase::Settled;
        }
        for facet in self.agenda.order().fresh() {
            self.facets[facet].phase = Phase::Settled;
        }
        self.vertex_order.settle();
        self.agenda.settle();
    }

    /// Makes a facet a polygon, with ridges towards all neighbours.
    pub(super) fn become_polygon(&mut self, facet: FacetId) {
        if self.facets[facet].shape == Shape::Polygon {
            return;
        }
        let already = self.facets[facet].ridges.len();
        for k in 0..self.facets[facet].neighbors.len() {
            let of = &self.facets[facet];
            let neighbor = of.neighbors[k];
            if of.ridges[..already].iter().any(|&r| self.ridges[r].borders(neighbor)) {
                continue;
            }
            let sides = match of.side_opposite(k) {
                Side::Right => [facet, neighbor],
                Side::Left => [neighbor, facet],
            };
            let convexity = if of.tested { Convexity::Convex } else { Convexity::Unknown };
            let ridge = self.ridges.push(Ridge { ends: of.edge_opposite(k), sides, convexity });
            for side in sides {
                self.facets[side].ridges.push(ridge);
                if self.facets[side].shape == Shape::Triangle {
                    self.facets[side].shape = Shape::RidgedTriangle;
                }
            }
        }
        self.facets[facet].shape = Shape::Polygon;
    }

    /// Starts to keep account of the facets around each vertex. Until two facets are united nothing asks for
    /// them, and then their order is that of the facets.
    pub(super) fn keep_around(&mut self) {
        if std::mem::replace(&mut self.keeps_around, true) {
            return;
        }
        for facet in self.agenda.order().iter() {
            for &corner in &self.facets[facet].corners {
                self.vertices[corner].around.push(facet);
            }
        }
    }

    /// Marks the corners of `facet` as `own`.
    pub(super) fn mark_corners(&mut self, facet: FacetId) {
        self.own.clear();
        for &corner in &self.facets[facet].corners {
            self.own.add(corner);
        }
    }
}

/// Takes an item out of a list; the last one takes its place. Lists of neighbours and ridges are searched in
/// order, so the place matters.
pub(super) fn take_out<T: PartialEq>(list: &mut Vec<T>, item: T) {
    if let Some(at) = list.iter().position(|x| *x == item) {
        list.swap_remove(at);
    }
}

/// Puts `new` where `old` is.
pub(super) fn replace<T: PartialEq>(list: &mut [T], old: T, new: T) -> Result<(), Failure> {
    let slot = list.iter_mut().find(|x| **x == old);
    *slot.ok_or(Failure("facets disagree about being neighbours"))? = new;
    Ok(())
}
