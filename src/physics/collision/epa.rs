//! Penetration depth of convex bodies: the expanding polytope algorithm
//! (van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001).
//!
//! A polytope inside the Minkowski difference grows from the simplex in which GJK ended. Its face nearest to the
//! origin bounds the depth from below, the support point beyond that face bounds it from above; the polytope takes
//! in that point, until the bounds meet.

use super::gjk::{BEYOND, Limits, Vertex, combine3, project_on_plane, projected_areas, support};
use super::support::ConvexBody;
use crate::math::{Mat3, Vec3, add, cross, dot, mul_mat_vec, norm, scale, sub};
use crate::model::bounds::MINVAL;

/// A face whose squared distance to the origin is smaller holds the origin.
const ON_FACE2: f64 = MINVAL * MINVAL;
/// The upper bound may fall short of the lower one by rounding, not by more than this [m].
const BOUND_SLACK: f64 = 1e-10;
const MAX_ITERATIONS: usize = 1000;

/// Where the search for the nearest face may find a face.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Candidate with this place in the list.
    Open(usize),
    /// On the polytope, but too far to be the answer.
    Shut,
    /// Swallowed by the growing polytope.
    Gone,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    vertex: [usize; 3],
    /// Faces across the edges 01, 12, 20.
    across: [usize; 3],
    /// The origin projected on the plane, turned outward.
    foot: Vec3,
    dist2: f64,
    state: State,
}

/// The growing polytope; its memory is reused.
#[derive(Clone, Debug, Default)]
pub struct Polytope {
    vertex: Vec<Vertex>,
    face: Vec<Face>,
    /// Candidates with their squared distances.
    open: Vec<(usize, f64)>,
    /// Edges around the part that a new vertex sees: face beyond the edge, and which of its edges it is.
    horizon: Vec<(usize, usize)>,
    center: Vec3,
}

/// Depth, nearest points and supporting vertices of two bodies that overlap.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    /// Signed distance, not positive [m].
    pub dist: f64,
    /// Deepest points of the two bodies.
    pub nearest: [Vec3; 2],
    /// Corners of the face of the Minkowski difference that holds them.
    pub face: [Vertex; 3],
}

/// Why no depth was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The bipyramid over a segment is not convex.
    NonConvex,
    /// The triangle has no area.
    BadNormal,
    /// An apex over the triangle lies in it.
    FlatApex,
    /// The origin is on a face of the bipyramid over a triangle.
    OriginOnFace,
    /// The tetrahedron does not hold the origin.
    OriginOutside,
    /// Rounding broke the polytope while it grew.
    Broken,
}

impl Polytope {
    /// Penetration of two bodies from the last simplex of GJK: two to four vertices.
    pub fn penetration(
        &mut self,
        a: &mut ConvexBody,
        b: &mut ConvexBody,
        limits: &Limits,
        simplex: &[Vertex],
    ) -> Result<Penetration, Failure> {
        self.clear();
        match simplex {
            [s1, s2] => self.enclose_segment(a, b, s1, s2)?,
            &[s1, s2, s3] => self.enclose_triangle(a, b, &[s1, s2, s3])?,
            _ => self.enclose_tetrahedron(a, b, simplex.try_into().map_err(|_| Failure::OriginOutside)?)?,
        }
        let face = self.expand(a, b, limits).ok_or(Failure::Broken)?;
        Ok(self.witness(face))
    }

    fn clear(&mut self) {
        self.vertex.clear();
        self.face.clear();
        self.open.clear();
        self.horizon.clear();
    }

    fn push(&mut self, v: Vertex) -> usize {
        self.vertex.push(v);
        self.vertex.len() - 1
    }

    /// Adds the support point in direction `d`, whose length is `length`.
    fn push_support(&mut self, a: &mut ConvexBody, b: &mut ConvexBody, d: Vec3, length: f64) -> usize {
        let dir = if length > MINVAL { d.map(|x| x / length) } else { [1.0, 0.0, 0.0] };
        let v = self.push(Vertex::default());
        support(a, b, dir, &mut self.vertex[v]);
        v
    }

    fn diff(&self, v: usize) -> Vec3 {
        self.vertex[v].diff
    }

    /// Adds a face and returns the squared distance of its plane from the origin, 0 for a face without area.
    // Inlined: vectors passed to a call go through memory, and reading them back in other pieces
    // than they were written in stalls.
    #[inline(always)]
    fn push_face(&mut self, vertex: [usize; 3], across: [usize; 3]) -> f64 {
        let [v1, v2, v3] = vertex.map(|v| self.diff(v));
        let foot = project_on_plane(v3, v2, v1).unwrap_or_default();
        let dist2 = dot(foot, foot);
        let inward = dot(foot, sub(v1, self.center)) < 0.0;
        let foot = if inward { scale(foot, -1.0) } else { foot };
        self.face.push(Face { vertex, across, foot, dist2, state: State::Shut });
        dist2
    }

    fn open_face(&mut self, f: usize) {
        let face = &mut self.face[f];
        face.state = State::Open(self.open.len());
        self.open.push((f, face.dist2));
    }

    fn open_all(&mut self) {
        for f in 0..self.face.len() {
            self.open_face(f);
        }
    }

    fn remove_face(&mut self, f: usize) {
        if let State::Open(place) = self.face[f].state {
            self.open.swap_remove(place);
            if let Some(&(moved, _)) = self.open.get(place) {
                self.face[moved].state = State::Open(place);
            }
        }
        self.face[f].state = State::Gone;
    }

    /// Bipyramid over three support points around the segment.
    fn enclose_segment(
        &mut self,
        a: &mut ConvexBody,
        b: &mut ConvexBody,
        s1: &Vertex,
        s2: &Vertex,
    ) -> Result<(), Failure> {
        self.center = scale(add(s1.diff, s2.diff), 0.5);
        let along = sub(s2.diff, s1.diff);
        let mut axis = 0;
        for i in 1..3 {
            if along[i].abs() < along[axis].abs() {
                axis = i;
            }
        }
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let d1 = cross(unit, along);
        let turn = third_of_a_turn(along);
        let d2 = mul_mat_vec(&turn, d1);
        let d3 = mul_mat_vec(&turn, d2);

        let (v1, v2) = (self.push(*s1), self.push(*s2));
        let [v3, v4, v5] = [d1, d2, d3].map(|d| self.push_support(a, b, d, norm(d)));
        let faces = [
            ([v1, v3, v4], [1, 3, 2]),
            ([v1, v5, v3], [2, 4, 0]),
            ([v1, v4, v5], [0, 5, 1]),
            ([v2, v4, v3], [5, 0, 4]),
            ([v2, v3, v5], [3, 1, 5]),
            ([v2, v5, v4], [4, 2, 3]),
        ];
        for (vertex, across) in faces {
            if self.push_face(vertex, across) < ON_FACE2 {
                return self.restart_from_face(a, b, vertex);
            }
        }
        if !line_meets_triangle(s1.diff, s2.diff, [v3, v4, v5].map(|v| self.diff(v))) {
            return Err(Failure::NonConvex);
        }
        self.open_all();
        Ok(())
    }

    /// Begins again from a face that holds the origin.
    fn restart_from_face(
        &mut self,
        a: &mut ConvexBody,
        b: &mut ConvexBody,
        vertex: [usize; 3],
    ) -> Result<(), Failure> {
        let simplex = vertex.map(|v| self.vertex[v]);
        self.clear();
        self.enclose_triangle(a, b, &simplex)
    }

    /// Bipyramid over the triangle, its apexes the support points along the normal.
    fn enclose_triangle(
        &mut self,
        a: &mut ConvexBody,
        b: &mut ConvexBody,
        simplex: &[Vertex; 3],
    ) -> Result<(), Failure> {
        let [p1, p2, p3] = [0, 1, 2].map(|i: usize| simplex[i].diff);
        self.center = scale(add(add(p1, p2), p3), 1.0 / 3.0);
        let normal = cross(sub(p2, p1), sub(p3, p1));
        let length = norm(normal);
        if length < MINVAL {
            return Err(Failure::BadNormal);
        }
        let [v1, v2, v3] = [0, 1, 2];
        self.vertex.extend_from_slice(simplex);
        let v5 = self.push_support(a, b, scale(normal, -1.0), length);
        let v4 = self.push_support(a, b, normal, length);
        if in_triangle(p1, p2, p3, self.diff(v4)) || in_triangle(p1, p2, p3, self.diff(v5)) {
            return Err(Failure::FlatApex);
        }
        let faces = [
            ([v4, v1, v2], [1, 3, 2]),
            ([v4, v3, v1], [2, 4, 0]),
            ([v4, v2, v3], [0, 5, 1]),
            ([v5, v2, v1], [5, 0, 4]),
            ([v5, v1, v3], [3, 1, 5]),
            ([v5, v3, v2], [4, 2, 3]),
        ];
        for (vertex, across) in faces {
            if self.push_face(vertex, across) < ON_FACE2 {
                return Err(Failure::OriginOnFace);
            }
        }
        self.open_all();
        Ok(())
    }

    /// The tetrahedron itself.
    fn enclose_tetrahedron(
        &mut self,
        a: &mut ConvexBody,
        b: &mut ConvexBody,
        simplex: &[Vertex; 4],
    ) -> Result<(), Failure> {
        let [p1, p2, p3, p4] = [0, 1, 2, 3].map(|i: usize| simplex[i].diff);
        self.center = scale(add(add(add(p1, p2), p3), p4), 0.25);
        let [v1, v2, v3, v4] = [0, 1, 2, 3];
        self.vertex.extend_from_slice(simplex);
        let faces = [
            ([v1, v2, v3], [1, 3, 2]),
            ([v1, v4, v2], [2, 3, 0]),
            ([v1, v3, v4], [0, 3, 1]),
            ([v4, v3, v2], [2, 0, 1]),
        ];
        for (vertex, across) in faces {
            if self.push_face(vertex, across) < ON_FACE2 {
                return self.restart_from_face(a, b, vertex);
            }
        }
        if !holds_origin(p1, p2, p3, p4) {
            return Err(Failure::OriginOutside);
        }
        self.open_all();
        Ok(())
    }

    /// Nearest candidate to the origin and its squared distance.
    fn nearest_face(&self) -> Option<(usize, f64)> {
        let mut best = None;
        let mut lower2 = BEYOND;
        for &(f, dist2) in &self.open {
            if dist2 < lower2 {
                lower2 = dist2;
                best = Some((f, lower2));
            }
        }
        best
    }

    /// Grows the polytope until its nearest face is on the boundary of the difference; returns that face.
    fn expand(&mut self, a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits) -> Option<usize> {
        let discrete = a.is_discrete() && b.is_discrete();
        let tolerance = if discrete { MINVAL } else { limits.tolerance };
        let max_faces = 6 * limits.iterations;
        let (mut upper, mut upper2) = (BEYOND, BEYOND);
        let mut answer = None;
        for k in 0..limits.iterations.min(MAX_ITERATIONS) {
            let Some((face, lower2)) = self.nearest_face() else { return answer };
            if lower2 > upper2 {
                return answer;
            }
            answer = Some(face);
            if lower2 <= 0.0 {
                return answer;
            }
            let lower = lower2.sqrt();
            let foot = self.face[face].foot;
            let w = self.push_support(a, b, foot, lower);
            let height = dot(foot, self.diff(w)) / lower;
            if height < upper {
                upper = height;
                upper2 = upper * upper;
            }
            if upper - lower < tolerance {
                let missed = k == 0 && upper < lower - BOUND_SLACK;
                return if missed { None } else { answer };
            }
            if discrete && self.is_repeated(w) {
                return answer;
            }
            self.horizon.clear();
            self.swallow(face, 0, 3, self.diff(w));
            if self.horizon.len() < 3 {
                return None;
            }
            if self.horizon.len() > max_faces - self.face.len() {
                return answer;
            }
            if !self.close_over_horizon(w, lower2, upper2) {
                return None;
            }
            if self.open.is_empty() {
                return answer;
            }
        }
        answer
    }

    fn is_repeated(&self, w: usize) -> bool {
        let index = self.vertex[w].index;
        self.vertex[..w].iter().any(|v| v.index == index)
    }

    /// Removes a face that sees `w` and those that do beyond `count` of its edges from `edge` on, and lists the edges
    /// around them in `horizon`.
    fn swallow(&mut self, face: usize, edge: usize, count: usize, w: Vec3) {
        self.remove_face(face);
        let Face { vertex, across, .. } = self.face[face];
        let mut edge = edge;
        for _ in 0..count {
            let (beyond, end) = (across[edge], vertex[next(edge)]);
            edge = next(edge);
            let Face { vertex, foot, dist2, state, .. } = &self.face[beyond];
            if *state == State::Gone {
                continue;
            }
            let entry = vertex.iter().position(|&v| v == end).unwrap_or(2);
            if dot(*foot, w) - dist2 > MINVAL {
                self.swallow(beyond, next(entry), 2, w);
            } else {
                self.horizon.push((beyond, entry));
            }
        }
    }

    /// Fills the hole with faces from its edges to `w`; false when one of them has no area. Faces nearer than the
    /// upper bound become candidates.
    fn close_over_horizon(&mut self, w: usize, lower2: f64, upper2: f64) -> bool {
        let (first, count) = (self.face.len(), self.horizon.len());
        let last = first + count - 1;
        for i in 0..count {
            let (beyond, edge) = self.horizon[i];
            let new = first + i;
            let before = if new == first { last } else { new - 1 };
            let after = if new == last { first } else { new + 1 };
            let old = &mut self.face[beyond];
            let (v1, v2) = (old.vertex[edge], old.vertex[next(edge)]);
            old.across[edge] = new;
            let dist2 = self.push_face([w, v2, v1], [before, beyond, after]);
            if dist2 == 0.0 {
                return false;
            }
            if dist2 >= lower2 && dist2 <= upper2 {
                self.open_face(new);
            }
        }
        true
    }

    /// Points of the two bodies under the foot of a face.
    fn witness(&self, f: usize) -> Penetration {
        let face = &self.face[f];
        let corners = face.vertex.map(|v| self.vertex[v]);
        let [v1, v2, v3] = corners;
        let (total, area) = projected_areas(v1.diff, v2.diff, v3.diff, face.foot);
        let weight = area.map(|x| x / total);
        Penetration {
            dist: -face.dist2.sqrt(),
            nearest: [combine3(&weight, v1.a, v2.a, v3.a), combine3(&weight, v1.b, v2.b, v3.b)],
            face: corners,
        }
    }
}

/// The edge or corner of a triangle after this one.
fn next(corner: usize) -> usize {
    if corner == 2 { 0 } else { corner + 1 }
}

/// Rotation by 120 degrees about `axis`; the sine has the digits MuJoCo gives it.
fn third_of_a_turn(axis: Vec3) -> Mat3 {
    let length = norm(axis);
    let [x, y, z] = axis.map(|u| u / length);
    let (sin, cos) = (0.86602540378, -0.5);
    let versine = 1.0 - cos;
    [
        cos + x * x * versine,
        x * y * versine - z * sin,
        x * z * versine + y * sin,
        y * x * versine + z * sin,
        cos + y * y * versine,
        y * z * versine - x * sin,
        x * z * versine - y * sin,
        y * z * versine + x * sin,
        cos + z * z * versine,
    ]
}

/// True when the line through `p` and `q` meets a triangle.
fn line_meets_triangle(p: Vec3, q: Vec3, triangle: [Vec3; 3]) -> bool {
    let along = sub(q, p);
    let [d1, d2, d3] = triangle.map(|v| sub(v, p));
    let volume = |u: Vec3, v: Vec3| dot(u, cross(v, along));
    let volumes = [volume(d1, d2), volume(d2, d3), volume(d3, d1)];
    volumes.iter().all(|&v| v >= 0.0) || volumes.iter().all(|&v| v <= 0.0)
}

/// True when `p` lies in a triangle, up to rounding.
fn in_triangle(v1: Vec3, v2: Vec3, v3: Vec3, p: Vec3) -> bool {
    let (total, area) = projected_areas(v1, v2, v3, p);
    let weight = area.map(|a| a / total);
    if weight.iter().any(|&w| w < 0.0) {
        return false;
    }
    norm(sub(combine3(&weight, v1, v2, v3), p)) < MINVAL
}

/// True when the origin lies strictly within a tetrahedron.
fn holds_origin(p1: Vec3, p2: Vec3, p3: Vec3, p4: Vec3) -> bool {
    let same_side = |a: Vec3, b: Vec3, c: Vec3, d: Vec3| {
        let normal = cross(sub(b, a), sub(c, a));
        let (s, t) = (dot(normal, sub(d, a)), dot(normal, scale(a, -1.0)));
        (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0)
    };
    same_side(p1, p2, p3, p4)
        && same_side(p2, p3, p4, p1)
        && same_side(p3, p4, p1, p2)
        && same_side(p4, p1, p2, p3)
}
