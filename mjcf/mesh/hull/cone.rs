//! A new point: the facets below it, the horizon around them, and the cone of triangles from the point to
//! the horizon.

use super::builder::Builder;
use super::failure::Failure;
use super::id::{FacetId, Marks, RidgeId, VertexId};
use super::surface::{Phase, Shape, Side, Surface, replace, take_out};

/// A part of the border between the hidden facets and the rest of the hull.
struct Edge {
    hidden: FacetId,
    beyond: FacetId,
    /// The newer vertex first.
    ends: [VertexId; 2],
    /// Where the hidden facet lies, and the triangle that takes its place will.
    side: Side,
    /// `None` between two triangles.
    ridge: Option<RidgeId>,
}

/// The border of the hidden facets.
pub(super) struct Horizon {
    /// Grouped by hidden facet, in their order; ridges before edges between triangles.
    edges: Vec<Edge>,
    /// Facets beyond the horizon in whose plane the point lies, within round-off.
    level: Marks<FacetId>,
}

/// A new triangle in the plane of the facet beyond its part of the horizon.
pub(super) struct Level {
    pub triangle: FacetId,
    pub beyond: FacetId,
}

impl Builder<'_> {
    /// Hides the facets that the point sees, beginning with one of them, and finds the horizon.
    pub(super) fn trace_horizon(&mut self, point: usize, first: FacetId) -> Result<Horizon, Failure> {
        let level = self.hide_visible(self.points[point], first);
        let mut edges = Vec::new();
        for k in 0..self.surface.hidden.len() {
            self.surface.list_edges(self.surface.hidden[k], &mut edges)?;
        }
        if edges.is_empty() {
            return Err(Failure("a point is above all facets"));
        }
        Ok(Horizon { edges, level })
    }

    /// Hides what the point sees, from neighbour to neighbour in breadth-first order. Returns the facets
    /// beyond in whose plane it lies.
    fn hide_visible(&mut self, point: [f64; 3], first: FacetId) -> Marks<FacetId> {
        let visible = self.tol.visible;
        let mut level = Marks::default();
        self.surface.passed.clear();
        self.surface.passed.add(first);
        self.surface.hide(first);
        let mut next = 0;
        while let Some(&at) = self.surface.hidden.get(next) {
            next += 1;
            for k in 0..self.surface.facets[at].neighbors.len() {
                let neighbor = self.surface.facets[at].neighbors[k];
                if !self.surface.passed.add(neighbor) {
                    continue;
                }
                let height = self.height(point, neighbor);
                if height > visible {
                    self.surface.hide(neighbor);
                } else if height >= -visible {
                    level.add(neighbor);
                    self.slack.allow(height);
                }
            }
        }
        level
    }

    /// Joins the point to the horizon. Returns the triangles that are to continue a facet beyond; only the
    /// others have planes.
    pub(super) fn raise_cone(&mut self, point: usize, horizon: Horizon) -> Result<Vec<Level>, Failure> {
        let apex = self.surface.add_vertex(point);
        let mut level = Vec::new();
        let mut edges = horizon.edges.into_iter().peekable();
        let (mut over_ridges, mut heir) = (None, None);
        for k in 0..self.surface.hidden.len() {
            let hidden = self.surface.hidden[k];
            let (mut over_ridge, mut over_edge) = (None, None);
            while let Some(edge) = edges.next_if(|edge| edge.hidden == hidden) {
                let triangle = self.surface.raise_triangle(apex, &edge)?;
                if horizon.level.has(edge.beyond) {
                    level.push(Level { triangle, beyond: edge.beyond });
                }
                *(if edge.ridge.is_some() { &mut over_ridge } else { &mut over_edge }) = Some(triangle);
            }
            // A facet without horizon shares the heir of one before it. Searches start at the heir, and where
            // they start decides which of several facets gets a point.
            let shape = self.surface.facets[hidden].shape;
            if shape != Shape::Triangle {
                over_ridges = over_ridge;
            }
            if shape.is_triangle() {
                heir = over_edge;
            }
            heir = over_ridges.or(heir);
            self.surface.facets[hidden].phase = Phase::Removed { heir };
        }
        self.surface.close_cone()?;
        self.set_cone_planes(&level);
        self.surface.drop_hidden_vertices();
        Ok(level)
    }

    fn set_cone_planes(&mut self, level: &[Level]) {
        let mut level = level.iter().map(|level| level.triangle).peekable();
        let mut at = self.surface.agenda.order().first_fresh();
        while let Some(triangle) = at {
            if level.next_if_eq(&triangle).is_none() {
                self.set_plane(triangle);
            }
            at = self.surface.agenda.order().after(triangle);
        }
    }
}

impl Surface {
    /// Adds the parts of the border of a hidden facet behind which the hull stays: its ridges, then edges
    /// towards triangles.
    fn list_edges(&mut self, hidden: FacetId, edges: &mut Vec<Edge>) -> Result<(), Failure> {
        let Self { facets, ridges, passed, .. } = self;
        let facet = &facets[hidden];
        // Neighbours behind a ridge.
        passed.clear();
        for &id in &facet.ridges {
            let ridge = &ridges[id];
            let beyond = ridge.beyond(hidden);
            passed.add(beyond);
            if !facets[beyond].phase.is_removed() {
                let (ends, side) = (ridge.ends, ridge.side_of(hidden));
                edges.push(Edge { hidden, beyond, ends, side, ridge: Some(id) });
            }
        }
        if !facet.shape.is_triangle() {
            return Ok(());
        }
        for &beyond in &facet.neighbors {
            let other = &facets[beyond];
            if other.phase.is_removed() || passed.has(beyond) {
                continue;
            }
            let slot = other.neighbors.iter().position(|&facet| facet == hidden);
            let slot = slot.filter(|_| other.shape.is_triangle());
            let slot = slot.ok_or(Failure("facets disagree about being neighbours"))?;
            let side = other.side_opposite(slot).opposite();
            edges.push(Edge { hidden, beyond, ends: other.edge_opposite(slot), side, ridge: None });
        }
        Ok(())
    }

    /// A triangle from the apex to an edge of the horizon, where it takes the place of the hidden facet.
    fn raise_triangle(&mut self, apex: VertexId, edge: &Edge) -> Result<FacetId, Failure> {
        let &Edge { hidden, beyond, ends: [newer, older], side, ridge } = edge;
        let triangle = self.add_triangle([apex, newer, older], side);
        // The neighbours in the cone are found when it closes.
        self.facets[triangle].neighbors.extend([beyond; 3]);
        let beyond_is_triangle = self.facets[beyond].shape.is_triangle();
        match replace(&mut self.facets[beyond].neighbors, hidden, triangle) {
            Ok(()) => {}
            // The second edge between two polygons: the first took the place in the list.
            Err(_) if ridge.is_some() && !beyond_is_triangle => self.facets[beyond].neighbors.push(triangle),
            Err(failure) => return Err(failure),
        }
        let Some(ridge) = ridge else { return Ok(triangle) };
        if beyond_is_triangle {
            take_out(&mut self.facets[beyond].ridges, ridge);
        } else {
            self.ridges[ridge].hand_over(hidden, triangle);
            self.facets[triangle].ridges.push(ridge);
            self.facets[triangle].shape = Shape::RidgedTriangle;
        }
        Ok(triangle)
    }

    /// Makes the fresh triangles neighbours along the edges from the apex. Around a horizon without branches
    /// one triangle ends and one begins at each vertex.
    fn close_cone(&mut self) -> Result<(), Failure> {
        let Self { facets, agenda, joints, .. } = self;
        for triangle in agenda.order().fresh() {
            let side = facets[triangle].side;
            for (k, side) in [(1, side), (2, side.opposite())] {
                let joint = &mut joints[facets[triangle].corners[k]];
                if joint[side as usize].replace((triangle, 3 - k)).is_some() {
                    return Err(Failure("the horizon touches itself"));
                }
            }
        }
        for triangle in agenda.order().fresh() {
            for k in [1, 2] {
                let joint = joints[facets[triangle].corners[k]];
                let [Some((a, in_a)), Some((b, in_b))] = joint else {
                    return Err(Failure("the horizon is not closed"));
                };
                facets[a].neighbors[in_a] = b;
                facets[b].neighbors[in_b] = a;
            }
        }
        for triangle in agenda.order().fresh() {
            for &corner in &facets[triangle].corners {
                joints[corner] = [None; 2];
            }
        }
        Ok(())
    }

    /// Removes the vertices inside the horizon, and brings the lists of facets around vertices up to date.
    fn drop_hidden_vertices(&mut self) {
        if self.keeps_around {
            let Self { facets, vertices, vertex_order, agenda, .. } = self;
            for vertex in vertex_order.fresh() {
                let around = &mut vertices[vertex].around;
                let mut k = 0;
                while k < around.len() {
                    if facets[around[k]].phase.is_removed() {
                        around.swap_remove(k);
                    } else {
                        k += 1;
                    }
                }
            }
            for triangle in agenda.order().fresh() {
                for &corner in &facets[triangle].corners {
                    vertices[corner].around.push(triangle);
                }
            }
        }
        for k in 0..self.hidden.len() {
            let hidden = self.hidden[k];
            for k in 0..self.facets[hidden].corners.len() {
                let corner = self.facets[hidden].corners[k];
                if self.vertices[corner].phase == Phase::Settled {
                    self.lose_vertex(corner);
                }
            }
        }
    }
}
