//! A polytope with triangular faces that grows around the origin, one vertex at a time: the data structure of
//! penetration depth.
//!
//! Invariants: the faces that are not gone close the surface, so that the face beyond an edge has the same edge,
//! in the other direction, and leads back; the candidates are the faces among which the nearest to the origin is
//! looked for, and each knows its place in their list.

use super::gjk::{BEYOND, Vertex, project_on_plane};
use crate::math::{Vec3, dot, scale, sub};
use crate::model::bounds::MINVAL;
use std::ops::RangeInclusive;

/// A face whose squared distance to the origin is smaller holds the origin.
const ON_FACE2: f64 = MINVAL * MINVAL;

/// Where the search for the nearest face may find a face.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Candidate with this place in the list.
    Candidate(usize),
    /// On the polytope, but too far to be the answer.
    Far,
    /// Swallowed by the growing polytope.
    Gone,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    corners: [usize; 3],
    /// Faces beyond the edges 01, 12, 20.
    beyond: [usize; 3],
    /// The origin projected on the plane, turned outward.
    foot: Vec3,
    dist2: f64,
    state: State,
}

/// A face and one of its edges, by the corner at which it begins.
#[derive(Clone, Copy, Debug)]
struct Side {
    face: usize,
    edge: usize,
}

/// A face of the first polytope: its corners, as places in the list of vertices, and the faces beyond its edges.
pub type Pattern = ([usize; 3], [usize; 3]);

/// A face, whose corners these are, holds the origin.
#[derive(Clone, Copy, Debug)]
pub struct OnFace(pub [usize; 3]);

/// How the polytope took in a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absorption {
    /// The vertex is a corner of the new faces.
    Done,
    /// There is no room for the new faces.
    Full,
    /// Rounding left no closed surface, or a face without area.
    Torn,
}

/// The growing polytope; its memory is reused.
#[derive(Clone, Debug, Default)]
pub struct Polytope {
    vertices: Vec<Vertex>,
    faces: Vec<Face>,
    /// Faces and their squared distances.
    candidates: Vec<(usize, f64)>,
    /// Sides, of faces that stay, around the part that a new vertex sees.
    horizon: Vec<Side>,
    /// Sides of faces that are gone, yet to be looked across.
    frontier: Vec<Side>,
    /// An inner point.
    center: Vec3,
}

impl Polytope {
    /// An empty polytope around an inner point.
    pub fn begin(&mut self, center: Vec3) {
        self.vertices.clear();
        self.faces.clear();
        self.candidates.clear();
        self.center = center;
    }

    /// Adds a vertex that no face has yet; its number.
    pub fn add_vertex(&mut self, v: Vertex) -> usize {
        self.vertices.push(v);
        self.vertices.len() - 1
    }

    /// A vertex.
    pub fn vertex(&self, v: usize) -> &Vertex {
        &self.vertices[v]
    }

    /// A vertex to be written in place.
    pub fn vertex_mut(&mut self, v: usize) -> &mut Vertex {
        &mut self.vertices[v]
    }

    /// An earlier vertex comes from the same vertices of the bodies.
    pub fn repeats(&self, v: usize) -> bool {
        let index = self.vertices[v].index;
        self.vertices[..v].iter().any(|earlier| earlier.index == index)
    }

    /// Closes the first polytope over `vertices`. All its faces become candidates by [`Self::offer_all`].
    ///
    /// # Errors
    /// The first face that holds the origin or has no area.
    pub fn close(&mut self, pattern: &[Pattern], vertices: &[usize]) -> Result<(), OnFace> {
        for &(places, beyond) in pattern {
            let corners = places.map(|place| vertices[place]);
            if self.add_face(corners, beyond) < ON_FACE2 {
                return Err(OnFace(corners));
            }
        }
        Ok(())
    }

    /// Adds a face and returns the squared distance of its plane from the origin, 0 for a face without area.
    // Inlined: vectors passed to a call go through memory, and reading them back in other pieces
    // than they were written in stalls.
    #[inline(always)]
    fn add_face(&mut self, corners: [usize; 3], beyond: [usize; 3]) -> f64 {
        let [v1, v2, v3] = corners.map(|v| self.vertices[v].diff);
        let foot = project_on_plane(v3, v2, v1).unwrap_or_default();
        let dist2 = dot(foot, foot);
        let inward = dot(foot, sub(v1, self.center)) < 0.0;
        let foot = if inward { scale(foot, -1.0) } else { foot };
        self.faces.push(Face { corners, beyond, foot, dist2, state: State::Far });
        dist2
    }

    /// Makes every face a candidate.
    pub fn offer_all(&mut self) {
        for face in 0..self.faces.len() {
            self.offer(face);
        }
    }

    fn offer(&mut self, f: usize) {
        let face = &mut self.faces[f];
        face.state = State::Candidate(self.candidates.len());
        self.candidates.push((f, face.dist2));
    }

    fn remove(&mut self, f: usize) {
        if let State::Candidate(place) = self.faces[f].state {
            self.candidates.swap_remove(place);
            if let Some(&(moved, _)) = self.candidates.get(place) {
                self.faces[moved].state = State::Candidate(place);
            }
        }
        self.faces[f].state = State::Gone;
    }

    /// The candidate nearest to the origin and its squared distance; the first among equals.
    pub fn nearest_candidate(&self) -> Option<(usize, f64)> {
        let mut nearest = None;
        let mut least = BEYOND;
        for &(f, dist2) in &self.candidates {
            if dist2 < least {
                least = dist2;
                nearest = Some((f, dist2));
            }
        }
        nearest
    }

    /// The origin projected on the plane of a face, turned outward.
    pub fn foot(&self, f: usize) -> Vec3 {
        self.faces[f].foot
    }

    /// Squared distance of the plane of a face from the origin.
    pub fn dist2(&self, f: usize) -> f64 {
        self.faces[f].dist2
    }

    /// The corners of a face.
    pub fn corners(&self, f: usize) -> [Vertex; 3] {
        self.faces[f].corners.map(|v| self.vertices[v])
    }

    /// Takes in a vertex beyond `face`: the faces that see it give way to faces from the edges around them to the
    /// vertex. Of the new faces those whose squared distance lies in `candidates` become candidates.
    pub fn absorb(
        &mut self,
        vertex: usize,
        face: usize,
        candidates: RangeInclusive<f64>,
        max_faces: usize,
    ) -> Absorption {
        self.remove_visible(face, self.vertices[vertex].diff);
        if self.horizon.len() < 3 {
            return Absorption::Torn;
        }
        if self.faces.len() + self.horizon.len() > max_faces {
            return Absorption::Full;
        }
        if self.raise_cone(vertex, candidates) { Absorption::Done } else { Absorption::Torn }
    }

    /// Removes `face` and all faces that see `point` and are connected with it by such faces, and lists the horizon:
    /// the sides at which the surface that stays begins, in the order in which a walk around the hole meets them.
    fn remove_visible(&mut self, face: usize, point: Vec3) {
        self.horizon.clear();
        self.frontier.clear();
        self.remove(face);
        self.frontier.extend([2, 1, 0].map(|edge| Side { face, edge }));
        while let Some(gone) = self.frontier.pop() {
            let Face { corners, beyond, .. } = &self.faces[gone.face];
            let (face, end) = (beyond[gone.edge], corners[next(gone.edge)]);
            let Face { corners, foot, dist2, state, .. } = &self.faces[face];
            if *state == State::Gone {
                continue;
            }
            // The shared edge runs the other way here: it begins where it ended there.
            let edge = corners.iter().position(|&v| v == end).unwrap_or(2);
            if dot(*foot, point) - dist2 > MINVAL {
                self.remove(face);
                self.frontier.extend([next(next(edge)), next(edge)].map(|edge| Side { face, edge }));
            } else {
                self.horizon.push(Side { face, edge });
            }
        }
    }

    /// Closes the hole within the horizon with faces to `apex`, each beside the one before; false when one of them has
    /// no area.
    fn raise_cone(&mut self, apex: usize, candidates: RangeInclusive<f64>) -> bool {
        let first = self.faces.len();
        let last = first + self.horizon.len() - 1;
        for new in first..=last {
            let Side { face, edge } = self.horizon[new - first];
            let before = if new == first { last } else { new - 1 };
            let after = if new == last { first } else { new + 1 };
            let neighbour = &mut self.faces[face];
            neighbour.beyond[edge] = new;
            let [begin, end] = [edge, next(edge)].map(|k| neighbour.corners[k]);
            let dist2 = self.add_face([apex, end, begin], [before, face, after]);
            if dist2 == 0.0 {
                return false;
            }
            if candidates.contains(&dist2) {
                self.offer(new);
            }
        }
        true
    }
}

/// The edge or corner of a triangle after this one.
fn next(corner: usize) -> usize {
    if corner == 2 { 0 } else { corner + 1 }
}
