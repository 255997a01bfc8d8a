//! Penetration depth of convex bodies: the expanding polytope algorithm
//! (van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001).
//!
//! The depth is the distance of the origin from the boundary of the Minkowski difference. A polytope inside the
//! difference grows from the simplex in which GJK ended. It bounds the depth from both sides:
//!
//! - The boundary is no nearer than the polytope's nearest face, whose foot of the perpendicular is `f`: the depth is at
//!   least `|f|`.
//! - No point of the difference is higher along `f` than the support point `w`: the boundary is reached at height
//!   `w·f / |f|` at the latest, which the depth does not exceed.
//!
//! The polytope takes in `w` and has another nearest face, until the bounds meet.

use super::gjk::{BEYOND, Limits, Vertex, combine3, projected_areas, support};
use super::polytope::{Absorption, OnFace, Pattern, Polytope};
use super::support::ConvexBody;
use crate::math::{Mat3, Vec3, add, cross, dot, mul_mat_vec, norm, scale, sub};
use crate::model::bounds::MINVAL;

/// The upper bound may fall short of the lower one by rounding, not by more than this \[m\].
const BOUND_SLACK: f64 = 1e-10;
const MAX_ROUNDS: usize = 1000;
/// Faces that there is room for, for every iteration allowed.
const FACES_PER_ITERATION: usize = 6;

/// Faces of a bipyramid of two apexes and a triangle between them, in this order. The order decides which of equally
/// near faces is taken.
const BIPYRAMID: [Pattern; 6] = [
    ([0, 2, 3], [1, 3, 2]),
    ([0, 4, 2], [2, 4, 0]),
    ([0, 3, 4], [0, 5, 1]),
    ([1, 3, 2], [5, 0, 4]),
    ([1, 2, 4], [3, 1, 5]),
    ([1, 4, 3], [4, 2, 3]),
];
/// Faces of a tetrahedron.
const TETRAHEDRON: [Pattern; 4] =
    [([0, 1, 2], [1, 3, 2]), ([0, 3, 1], [2, 3, 0]), ([0, 2, 3], [0, 3, 1]), ([3, 2, 1], [2, 0, 1])];

/// Depth, nearest points and supporting vertices of two bodies that overlap.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    /// Signed distance, not positive \[m\].
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

/// Penetration of two bodies from the last simplex of GJK: two to four vertices. The polytope lends its memory.
///
/// # Errors
/// The simplex cannot be enclosed, or rounding broke the polytope.
pub fn penetration(
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    limits: &Limits,
    simplex: &[Vertex],
    polytope: &mut Polytope,
) -> Result<Penetration, Failure> {
    let mut hull = Hull { a, b, polytope };
    match *simplex {
        [s1, s2] => hull.enclose_segment([s1, s2])?,
        [s1, s2, s3] => hull.enclose_triangle([s1, s2, s3])?,
        [s1, s2, s3, s4] => hull.enclose_tetrahedron([s1, s2, s3, s4])?,
        _ => return Err(Failure::OriginOutside),
    }
    let face = Expansion::new(hull, limits).run().ok_or(Failure::Broken)?;
    Ok(witness(polytope, face))
}

/// A polytope of support points of the difference of two bodies.
struct Hull<'s, 'a, 'b> {
    a: &'s mut ConvexBody<'a>,
    b: &'s mut ConvexBody<'b>,
    polytope: &'s mut Polytope,
}

impl Hull<'_, '_, '_> {
    /// Adds the support point in direction `d`, whose length is `length`.
    fn add_support(&mut self, d: Vec3, length: f64) -> usize {
        let dir = if length > MINVAL { d.map(|x| x / length) } else { [1.0, 0.0, 0.0] };
        let v = self.polytope.add_vertex(Vertex::default());
        support(self.a, self.b, dir, self.polytope.vertex_mut(v));
        v
    }

    fn diff(&self, v: usize) -> Vec3 {
        self.polytope.vertex(v).diff
    }

    /// Bipyramid with the ends of the segment as apexes, over three support points around it.
    fn enclose_segment(&mut self, ends: [Vertex; 2]) -> Result<(), Failure> {
        let [p, q] = ends.map(|end| end.diff);
        let along = sub(q, p);
        self.polytope.begin(scale(add(p, q), 0.5));
        let flatter = |i: usize, j: usize| if along[j].abs() < along[i].abs() { j } else { i };
        let mut axis = [0.0; 3];
        axis[flatter(flatter(0, 1), 2)] = 1.0;
        let turn = third_of_a_turn(along);
        let first = cross(axis, along);
        let second = mul_mat_vec(&turn, first);
        let third = mul_mat_vec(&turn, second);

        let [top, bottom] = ends.map(|end| self.polytope.add_vertex(end));
        let ring = [first, second, third].map(|d| self.add_support(d, norm(d)));
        if let Err(face) = self.polytope.close(&BIPYRAMID, &[top, bottom, ring[0], ring[1], ring[2]]) {
            return self.enclose_face(face);
        }
        if !line_meets_triangle(p, q, ring.map(|v| self.diff(v))) {
            return Err(Failure::NonConvex);
        }
        self.polytope.offer_all();
        Ok(())
    }

    /// Begins again from a face that holds the origin.
    fn enclose_face(&mut self, OnFace(corners): OnFace) -> Result<(), Failure> {
        self.enclose_triangle(corners.map(|v| *self.polytope.vertex(v)))
    }

    /// Bipyramid over the triangle, its apexes the support points on either side.
    fn enclose_triangle(&mut self, corners: [Vertex; 3]) -> Result<(), Failure> {
        let [p1, p2, p3] = corners.map(|corner| corner.diff);
        self.polytope.begin(scale(add(add(p1, p2), p3), 1.0 / 3.0));
        let normal = cross(sub(p2, p1), sub(p3, p1));
        let length = norm(normal);
        if length < MINVAL {
            return Err(Failure::BadNormal);
        }
        let ring = corners.map(|corner| self.polytope.add_vertex(corner));
        let bottom = self.add_support(scale(normal, -1.0), length);
        let top = self.add_support(normal, length);
        if [top, bottom].iter().any(|&apex| in_triangle(p1, p2, p3, self.diff(apex))) {
            return Err(Failure::FlatApex);
        }
        self.polytope
            .close(&BIPYRAMID, &[top, bottom, ring[0], ring[1], ring[2]])
            .map_err(|_| Failure::OriginOnFace)?;
        self.polytope.offer_all();
        Ok(())
    }

    /// The tetrahedron itself.
    fn enclose_tetrahedron(&mut self, corners: [Vertex; 4]) -> Result<(), Failure> {
        let [p1, p2, p3, p4] = corners.map(|corner| corner.diff);
        self.polytope.begin(scale(add(add(add(p1, p2), p3), p4), 0.25));
        let vertices = corners.map(|corner| self.polytope.add_vertex(corner));
        if let Err(face) = self.polytope.close(&TETRAHEDRON, &vertices) {
            return self.enclose_face(face);
        }
        if !holds_origin([p1, p2, p3, p4]) {
            return Err(Failure::OriginOutside);
        }
        self.polytope.offer_all();
        Ok(())
    }
}

/// Bounds on the depth: each face has its own lower bound, its distance; the upper one holds for all.
struct Bounds {
    /// How near the bounds must come.
    tolerance: f64,
    /// Least height of a support point over the plane through the origin along which it was looked for.
    upper: f64,
    upper2: f64,
}

/// How a lower bound compares with the upper one.
enum Comparison {
    /// The depth may be anywhere between.
    Open,
    /// They agree up to the tolerance.
    Met,
    /// The lower one is greater, by more than rounding.
    Crossed,
}

impl Bounds {
    fn learn(&mut self, height: f64) {
        if height < self.upper {
            (self.upper, self.upper2) = (height, height * height);
        }
    }

    fn compare(&self, lower: f64) -> Comparison {
        if self.upper - lower < self.tolerance {
            if self.upper < lower - BOUND_SLACK { Comparison::Crossed } else { Comparison::Met }
        } else {
            Comparison::Open
        }
    }
}

/// The face nearest to the origin.
struct Target {
    face: usize,
    /// Squared distance of its plane from the origin.
    lower2: f64,
}

/// What the bodies show beyond a target.
enum Beyond {
    /// The target is on the boundary of the difference, or as near to it as can be told.
    Nothing,
    /// The difference ends before the target.
    Short,
    /// A vertex of the difference.
    Tip(usize),
}

/// The growth of a polytope toward the boundary of the difference.
struct Expansion<'s, 'a, 'b> {
    hull: Hull<'s, 'a, 'b>,
    /// Both bodies have finitely many support points.
    discrete: bool,
    iterations: usize,
    bounds: Bounds,
}

impl<'s, 'a, 'b> Expansion<'s, 'a, 'b> {
    fn new(hull: Hull<'s, 'a, 'b>, limits: &Limits) -> Self {
        let discrete = hull.a.is_discrete() && hull.b.is_discrete();
        let tolerance = if discrete { MINVAL } else { limits.tolerance };
        let bounds = Bounds { tolerance, upper: BEYOND, upper2: BEYOND };
        Expansion { hull, discrete, iterations: limits.iterations, bounds }
    }

    /// Grows the polytope until its nearest face is on the boundary of the difference; returns that face. `None` when the
    /// polytope is no longer sound.
    fn run(mut self) -> Option<usize> {
        let mut answer = None;
        for round in 0..self.iterations.min(MAX_ROUNDS) {
            let Some(target) = self.target() else { break };
            answer = Some(target.face);
            let tip = match self.look_beyond(&target) {
                Beyond::Tip(tip) => tip,
                // Later the bounds cross by errors that have gathered, but at first only if the bodies do not overlap.
                Beyond::Short if round == 0 => return None,
                Beyond::Short | Beyond::Nothing => break,
            };
            match self.take_in(tip, &target) {
                Absorption::Done => {}
                Absorption::Full => break,
                Absorption::Torn => return None,
            }
        }
        answer
    }

    /// The next face to look beyond; `None` when no face is below the upper bound, so that the one before is the answer.
    fn target(&self) -> Option<Target> {
        let (face, lower2) = self.hull.polytope.nearest_candidate()?;
        if lower2 > self.bounds.upper2 { None } else { Some(Target { face, lower2 }) }
    }

    /// Looks for the support point beyond a face, and learns from its height.
    fn look_beyond(&mut self, target: &Target) -> Beyond {
        if target.lower2 <= 0.0 {
            return Beyond::Nothing;
        }
        // The foot has the length of the distance: over it, an inner product is a height.
        let (foot, lower) = (self.hull.polytope.foot(target.face), target.lower2.sqrt());
        let tip = self.hull.add_support(foot, lower);
        self.bounds.learn(dot(foot, self.hull.diff(tip)) / lower);
        match self.bounds.compare(lower) {
            Comparison::Crossed => Beyond::Short,
            Comparison::Met => Beyond::Nothing,
            Comparison::Open if self.discrete && self.hull.polytope.repeats(tip) => Beyond::Nothing,
            Comparison::Open => Beyond::Tip(tip),
        }
    }

    /// Lets the polytope grow by a vertex. A new face below the lower bound is an artefact of rounding, one above the upper
    /// bound never the answer.
    fn take_in(&mut self, tip: usize, target: &Target) -> Absorption {
        let candidates = target.lower2..=self.bounds.upper2;
        self.hull.polytope.absorb(tip, target.face, candidates, FACES_PER_ITERATION * self.iterations)
    }
}

/// Points of the two bodies under the foot of a face.
fn witness(polytope: &Polytope, face: usize) -> Penetration {
    let corners = polytope.corners(face);
    let [v1, v2, v3] = corners;
    let (total, area) = projected_areas(v1.diff, v2.diff, v3.diff, polytope.foot(face));
    let weight = area.map(|x| x / total);
    Penetration {
        dist: -polytope.dist2(face).sqrt(),
        nearest: [combine3(&weight, v1.a, v2.a, v3.a), combine3(&weight, v1.b, v2.b, v3.b)],
        face: corners,
    }
}

/// Rotation by 120 degrees about `axis`: `cos I + (1 - cos) u uᵀ + sin [u]×` for the unit vector `u` (Rodrigues). The sine has
/// the digits MuJoCo gives it.
fn third_of_a_turn(axis: Vec3) -> Mat3 {
    const SIN: f64 = 0.86602540378;
    const COS: f64 = -0.5;
    let length = norm(axis);
    let u = axis.map(|x| x / length);
    let mut turn = [0.0; 9];
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (symmetric, skew) = (u[i] * u[j] * (1.0 - COS), u[k] * SIN);
        turn[3 * i + i] = COS + u[i] * u[i] * (1.0 - COS);
        turn[3 * i + j] = symmetric - skew;
        turn[3 * j + i] = symmetric + skew;
    }
    turn
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

/// True when the origin lies strictly within a tetrahedron: on the same side of each face as the corner opposite.
fn holds_origin(corners: [Vec3; 4]) -> bool {
    (0..4).all(|first| {
        let [a, b, c, opposite] = std::array::from_fn(|k| corners[(first + k) % 4]);
        let normal = cross(sub(b, a), sub(c, a));
        let (corner, origin) = (dot(normal, sub(opposite, a)), dot(normal, scale(a, -1.0)));
        (corner > 0.0 && origin > 0.0) || (corner < 0.0 && origin < 0.0)
    })
}
