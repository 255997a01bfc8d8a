//! Distance between convex bodies: the algorithm of Gilbert, Johnson and Keerthi (A Fast Procedure for Computing the Distance
//! Between Complex Objects in Three-Dimensional Space, 1988), with signed volumes (Montanari, Petrinic and Barbieri, Improving
//! the GJK Algorithm, ACM TOG 36, 2017).
//!
//! Two bodies are as far apart as the origin is from their Minkowski difference `A - B`. Let `x` be a point of the
//! difference and `s` its support point in direction `-x`. Every point `y` of the difference has `x·y ≥ x·s`, which bounds the
//! distance from both sides (van den Bergen, Collision Detection in Interactive 3D Environments, 2003, section 4.3):
//!
//! - The difference lies beyond the plane `x·y = x·s`: the distance is at least `x·s / |x|`, and at most `|x|`.
//! - For the nearest point `y`, `|y|² ≤ x·y` because `x` is in the difference too. So `|x - y|² = |x|² - 2 x·y + |y|²` is at most
//!   `|x|² - x·y`, and this at most `x·(x - s)`.
//!
//! Each round adds `s` to a simplex of support points and moves `x` to the point of the simplex nearest to the origin. Where only
//! contact matters, the first tetrahedron is turned toward the origin face by face instead, see `Tetrahedron`.

use super::support::ConvexBody;
use crate::math::{Vec3, add_scaled, cross, dot, norm, scale, sub};
use crate::model::bounds::{MAXVAL, MINVAL};
use std::ops::ControlFlow;

/// Value of a distance that is not known, only greater than the cut-off.
pub const BEYOND: f64 = f64::MAX;

/// Bounds on the work of GJK and of polytope expansion.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most iterations of each algorithm.
    pub iterations: usize,
    /// Tolerance on distance and depth \[m\].
    pub tolerance: f64,
    /// Distances are wanted up to here; 0 asks only whether the bodies touch \[m\].
    pub cutoff: f64,
}

/// A point of the Minkowski difference and the points of the bodies it comes from.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vertex {
    /// `a - b`.
    pub diff: Vec3,
    /// Point of the first body.
    pub a: Vec3,
    /// Point of the second body.
    pub b: Vec3,
    /// Vertices of the bodies, -1 for smooth ones.
    pub index: [i32; 2],
}

/// What GJK found.
#[derive(Clone, Copy, Debug)]
pub struct Proximity {
    /// Distance; [`BEYOND`] past the cut-off; 0 when a tetrahedron holds the origin \[m\].
    pub dist: f64,
    /// The bodies surely do not touch.
    pub separated: bool,
    /// Number of vertices of the last simplex.
    pub n: usize,
    /// Nearest points of the two bodies, when computed.
    pub nearest: Option<[Vec3; 2]>,
}

/// Support point of `A - B` in unit direction `dir`.
// Written in place: a copy right after the parts were written stalls.
pub fn support(a: &mut ConvexBody, b: &mut ConvexBody, dir: Vec3, out: &mut Vertex) {
    out.a = a.support(dir);
    out.b = b.support(scale(dir, -1.0));
    out.diff = sub(out.a, out.b);
    out.index = [a.last_vertex(), b.last_vertex()];
}

/// Unit direction from `x`, whose length is `length`, to the origin.
fn toward_origin(x: Vec3, length: f64) -> Vec3 {
    scale(scale(x, 1.0 / length), -1.0)
}

/// Distance between two bodies by GJK. Leaves the last simplex in `simplex`.
pub fn gjk(a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits, simplex: &mut [Vertex; 4]) -> Proximity {
    let mut nearest = [a.center(), b.center()];
    let x = sub(nearest[0], nearest[1]);
    let accuracy = Accuracy::new(a.is_discrete() && b.is_discrete(), limits.tolerance);
    let turns = limits.cutoff <= 0.0;
    let rounds = limits.iterations;
    let mut walk = Walk { a, b, simplex, weights: [0.0; 4], n: 0, x, length: norm(x), turns, rounds };
    let farthest = match walk.approach(&accuracy, limits.cutoff) {
        Arrival::Apart => return APART,
        Arrival::Inside => return Proximity { dist: 0.0, separated: false, n: 4, nearest: None },
        Arrival::Nearest(farthest) => farthest.unwrap_or_else(|| walk.farthest()),
    };
    let Walk { n, x, length, .. } = walk;
    if n > 0 {
        nearest = [walk.mean(|v| v.a), walk.mean(|v| v.b)];
    }
    let separated = dot(x, farthest) > 0.0;
    let dist = if n == 4 && !separated { 0.0 } else { length };
    Proximity { dist, separated, n, nearest: Some(nearest) }
}

/// How near to the truth the walk must come.
struct Accuracy {
    /// Bound on `|x - y|²` below which `x` counts as the nearest point.
    gap: f64,
    /// Length of `x` below which the bodies count as touching.
    touching: f64,
}

impl Accuracy {
    /// Polytopes have finitely many simplices, so nothing but rounding needs a tolerance; smooth bodies are approached
    /// forever.
    fn new(finite: bool, tolerance: f64) -> Self {
        if finite {
            Accuracy { gap: 0.0, touching: MINVAL }
        } else {
            Accuracy { gap: 0.5 * (tolerance * tolerance), touching: tolerance }
        }
    }
}

/// Where the walk ended.
enum Arrival {
    /// Past the cut-off.
    Apart,
    /// In a tetrahedron that holds the origin.
    Inside,
    /// At the point of the simplex nearest to the origin; with the last support point if that led no nearer.
    Nearest(Option<Vec3>),
}

/// A walk of simplices toward the origin.
struct Walk<'s, 'a, 'b> {
    a: &'s mut ConvexBody<'a>,
    b: &'s mut ConvexBody<'b>,
    simplex: &'s mut [Vertex; 4],
    /// Weights of the vertices in the nearest point.
    weights: [f64; 4],
    /// Vertices in use.
    n: usize,
    /// Point of the simplex nearest to the origin, at first the difference of the centres.
    x: Vec3,
    /// Length of `x`.
    length: f64,
    /// The next tetrahedron is turned toward the origin.
    turns: bool,
    /// Rounds left, of the walk and of turning together.
    rounds: usize,
}

impl Walk<'_, '_, '_> {
    #[inline(always)]
    fn approach(&mut self, accuracy: &Accuracy, cutoff: f64) -> Arrival {
        if self.length < accuracy.touching || self.length < MINVAL {
            return Arrival::Nearest(None);
        }
        while self.rounds > 0 {
            if let ControlFlow::Break(arrival) = self.round(accuracy, cutoff) {
                return arrival;
            }
            self.rounds = self.rounds.saturating_sub(1);
        }
        Arrival::Nearest(None)
    }

    /// One round: a support point joins the simplex, unless its plane says that the walk is over.
    #[inline(always)]
    fn round(&mut self, accuracy: &Accuracy, cutoff: f64) -> ControlFlow<Arrival> {
        support(self.a, self.b, toward_origin(self.x, self.length), &mut self.simplex[self.n]);
        let s = self.simplex[self.n].diff;
        if dot(self.x, sub(self.x, s)) < accuracy.gap {
            return ControlFlow::Break(Arrival::Nearest(Some(s)));
        }
        if plane_is_beyond(dot(self.x, s), self.length, cutoff) {
            return ControlFlow::Break(Arrival::Apart);
        }
        if self.turns && self.n == 3 {
            self.turns = false;
            let tetrahedron = Tetrahedron { a: self.a, b: self.b, corners: self.simplex };
            if let Some(arrival) = tetrahedron.turn(&mut self.rounds) {
                return ControlFlow::Break(arrival);
            }
        }
        let before = self.length;
        let stays = match self.reduce() {
            0 => return ControlFlow::Break(Arrival::Apart),
            4 => true,
            _ => self.length < accuracy.touching || (before - self.length).abs() < MINVAL,
        };
        if stays { ControlFlow::Break(Arrival::Nearest(None)) } else { ControlFlow::Continue(()) }
    }

    /// Moves to the nearest point of the simplex with the vertex that was added, and drops the vertices that are not
    /// needed for it; returns how many remain.
    #[inline(always)]
    fn reduce(&mut self) -> usize {
        self.weights = barycentric(self.simplex, self.n + 1);
        self.n = drop_unused(self.simplex, &mut self.weights);
        if self.n > 0 {
            self.x = self.mean(|v| v.diff);
            self.length = norm(self.x);
        }
        self.n
    }

    /// Mean of a point of the vertices.
    #[inline(always)]
    fn mean(&self, point: impl Fn(&Vertex) -> Vec3) -> Vec3 {
        combine(&self.weights, self.n, |i| point(&self.simplex[i]))
    }

    /// Support point toward the origin from where the walk ended.
    fn farthest(&mut self) -> Vec3 {
        let mut last = Vertex::default();
        support(self.a, self.b, toward_origin(self.x, self.length), &mut last);
        last.diff
    }
}

/// The plane `x·y = height`, `x` of this length, shows that the distance is beyond the cut-off; without a cut-off, that it
/// is not 0. Compared in squares: exact ties decide as in MuJoCo's release.
fn plane_is_beyond(height: f64, length: f64, cutoff: f64) -> bool {
    height > 0.0
        && (cutoff <= 0.0 || (cutoff < BEYOND && height * height >= length * length * (cutoff * cutoff)))
}

const APART: Proximity = Proximity { dist: BEYOND, separated: true, n: 0, nearest: None };

fn diffs(simplex: &[Vertex; 4]) -> [Vec3; 4] {
    [simplex[0].diff, simplex[1].diff, simplex[2].diff, simplex[3].diff]
}

/// Removes vertices of zero weight; returns how many remain.
fn drop_unused(simplex: &mut [Vertex; 4], lambda: &mut [f64; 4]) -> usize {
    let mut n = 0;
    for i in 0..4 {
        if lambda[i] != 0.0 {
            if n < i {
                simplex[n] = simplex[i];
                lambda[n] = lambda[i];
            }
            n += 1;
        }
    }
    n
}

/// Corners of the face opposite each corner of a tetrahedron, in the order in which its normal looks outward.
const OPPOSITE: [[usize; 3]; 4] = [[2, 1, 3], [0, 2, 3], [1, 0, 3], [0, 1, 2]];

/// A tetrahedron of support points that is turned until it holds the origin.
///
/// Let `n` be the outward unit normal of a face, `v` a point of the face and `h = n·v` its height over the origin. The origin is
/// inside the tetrahedron where all four heights are positive. If one is not, let `w` be the support point along its normal:
/// no point of the difference is higher than `n·w`, so for `n·w < 0` the origin is outside of the difference. Otherwise `w`
/// becomes the new apex over that face, on the side where the origin is, in place of the corner opposite the face.
struct Tetrahedron<'s, 'a, 'b> {
    a: &'s mut ConvexBody<'a>,
    b: &'s mut ConvexBody<'b>,
    corners: &'s mut [Vertex; 4],
}

/// Where the origin is relative to a tetrahedron.
enum Origin {
    Inside,
    /// In the plane of a face: the signs of the heights do not decide.
    InPlane,
    /// Outside of the face opposite this corner, the lowest of the four; with the normal of that face.
    Outside(usize, Vec3),
}

impl Tetrahedron<'_, '_, '_> {
    /// Turns until it is known whether the origin is in the difference. `None` where that stays open: the corners are then
    /// what they were. Uses up `rounds`.
    fn turn(self, rounds: &mut usize) -> Option<Arrival> {
        let mut unturned = None;
        while *rounds > 0 {
            let (apex, normal) = match self.locate_origin() {
                Origin::Inside => return Some(Arrival::Inside),
                Origin::InPlane => break,
                Origin::Outside(apex, normal) => (apex, normal),
            };
            unturned.get_or_insert(*self.corners);
            support(self.a, self.b, normal, &mut self.corners[apex]);
            if dot(normal, self.corners[apex].diff) < 0.0 {
                return Some(Arrival::Apart);
            }
            // The tetrahedron has turned inside out: exchanging two corners turns its normals outward.
            self.corners.swap((apex + 1) % 4, (apex + 2) % 4);
            *rounds -= 1;
        }
        if let Some(corners) = unturned {
            *self.corners = corners;
        }
        None
    }

    fn locate_origin(&self) -> Origin {
        let corners = diffs(self.corners);
        let faces = OPPOSITE.map(|[i, j, k]| plane_of_face(corners[i], corners[j], corners[k]));
        if faces.iter().any(|&(_, height)| height == 0.0) {
            return Origin::InPlane;
        }
        // The last of equally low faces.
        let lowest = (1..4).fold(0, |low, k| if faces[low].1 < faces[k].1 { low } else { k });
        let (normal, height) = faces[lowest];
        if height > 0.0 { Origin::Inside } else { Origin::Outside(lowest, normal) }
    }
}

/// Unit normal of a face and its height over the origin; [`BEYOND`] for a face without area.
// Inlined to keep vectors in registers, see `Polytope::add_face`.
#[inline(always)]
fn plane_of_face(v1: Vec3, v2: Vec3, v3: Vec3) -> (Vec3, f64) {
    let normal = cross(sub(v3, v1), sub(v2, v1));
    let area2 = dot(normal, normal);
    if area2 > MINVAL * MINVAL && area2 < MAXVAL * MAXVAL {
        let unit = scale(normal, 1.0 / area2.sqrt());
        (unit, dot(unit, v1))
    } else {
        (normal, BEYOND)
    }
}

/// Sum of the first `n` points with weights.
fn combine(weight: &[f64], n: usize, point: impl Fn(usize) -> Vec3) -> Vec3 {
    let mut sum = scale(point(0), weight[0]);
    for i in 1..n {
        sum = add_scaled(sum, point(i), weight[i]);
    }
    sum
}

/// `w1 v1 + w2 v2 + w3 v3`.
pub fn combine3(weight: &[f64; 3], v1: Vec3, v2: Vec3, v3: Vec3) -> Vec3 {
    let v = [v1, v2, v3];
    combine(weight, 3, |i| v[i])
}

/// Weights of the point of the simplex nearest to the origin; vertices that do not matter get exactly zero.
fn barycentric(simplex: &[Vertex; 4], n: usize) -> [f64; 4] {
    let [s1, s2, s3, s4] = diffs(simplex);
    match n {
        4 => tetrahedron(s1, s2, s3, s4),
        3 => {
            let [a, b, c] = triangle(s1, s2, s3);
            [a, b, c, 0.0]
        }
        2 => {
            let [a, b] = line(s1, s2);
            [a, b, 0.0, 0.0]
        }
        _ => [1.0, 0.0, 0.0, 0.0],
    }
}

fn same_sign(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

fn triple(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    dot(a, cross(b, c))
}

/// Signed volumes, three dimensions (Montanari et al., algorithm 3).
fn tetrahedron(s1: Vec3, s2: Vec3, s3: Vec3, s4: Vec3) -> [f64; 4] {
    let volume = [-triple(s2, s3, s4), triple(s1, s3, s4), -triple(s1, s2, s4), triple(s1, s2, s3)];
    let total = volume[0] + volume[1] + volume[2] + volume[3];
    let inside = volume.map(|v| same_sign(total, v));
    if inside == [true; 4] {
        return volume.map(|v| v / total);
    }
    let s = [s1, s2, s3, s4];
    let mut best = ([0.0; 4], BEYOND);
    for i in 0..4 {
        if inside[i] {
            continue;
        }
        let face = others4(i);
        let w = triangle(s[face[0]], s[face[1]], s[face[2]]);
        let x = combine3(&w, s[face[0]], s[face[1]], s[face[2]]);
        let d = dot(x, x);
        if i == 0 || d < best.1 {
            let mut lambda = [0.0; 4];
            for j in 0..3 {
                lambda[face[j]] = w[j];
            }
            best = (lambda, d);
        }
    }
    best.0
}

fn others4(i: usize) -> [usize; 3] {
    [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]][i]
}

/// Signed volumes, two dimensions (Montanari et al., algorithm 4).
fn triangle(s1: Vec3, s2: Vec3, s3: Vec3) -> [f64; 3] {
    let Some(p) = project_on_plane(s1, s2, s3) else {
        let [a, b] = line(s1, s2);
        return [a, b, 0.0];
    };
    let (total, area) = projected_areas(s1, s2, s3, p);
    let inside = area.map(|a| same_sign(total, a));
    if inside == [true; 3] {
        return area.map(|a| a / total);
    }
    let s = [s1, s2, s3];
    let mut best = ([0.0; 3], BEYOND);
    for (i, [j, k]) in [[1, 2], [0, 2], [0, 1]].into_iter().enumerate() {
        if inside[i] {
            continue;
        }
        let w = line(s[j], s[k]);
        let x = add_scaled(scale(s[j], w[0]), s[k], w[1]);
        let d = dot(x, x);
        if i == 0 || d < best.1 {
            let mut lambda = [0.0; 3];
            lambda[j] = w[0];
            lambda[k] = w[1];
            best = (lambda, d);
        }
    }
    best.0
}

/// Signed volumes, one dimension (Montanari et al., algorithm 5).
fn line(s1: Vec3, s2: Vec3) -> [f64; 2] {
    let d = sub(s2, s1);
    let p = add_scaled(s2, d, -(dot(s2, d) / dot(d, d)));
    let (mut axis, mut length) = (0, s1[0] - s2[0]);
    for i in 1..3 {
        let l = s1[i] - s2[i];
        if l.abs() >= length.abs() {
            (axis, length) = (i, l);
        }
    }
    let part = [p[axis] - s2[axis], s1[axis] - p[axis]];
    if same_sign(length, part[0]) && same_sign(length, part[1]) {
        part.map(|c| c / length)
    } else {
        [0.0, 1.0]
    }
}

/// Twice the signed areas of a triangle and of the three triangles that `p`, in its plane, makes with its edges,
/// all projected along the axis that keeps the most area.
pub fn projected_areas(v1: Vec3, v2: Vec3, v3: Vec3, p: Vec3) -> (f64, [f64; 3]) {
    let minor = |x: usize, y: usize| {
        v2[x] * v3[y] - v2[y] * v3[x] - v1[x] * v3[y] + v1[y] * v3[x] + v1[x] * v2[y] - v1[y] * v2[x]
    };
    let (yz, xz, xy) = (minor(1, 2), minor(0, 2), minor(0, 1));
    let (total, x, y) = if yz.abs() >= xz.abs() && yz.abs() >= xy.abs() {
        (yz, 1, 2)
    } else if xz.abs() >= xy.abs() {
        (xz, 0, 2)
    } else {
        (xy, 0, 1)
    };
    let area =
        |u: Vec3, v: Vec3| p[x] * u[y] + p[y] * v[x] + u[x] * v[y] - p[x] * v[y] - p[y] * u[x] - v[x] * u[y];
    (total, [area(v2, v3), area(v3, v1), area(v1, v2)])
}

/// The origin projected on the plane of three points, by the vertex whose edges show the plane best; `None` when
/// the points lie on a line.
// Inlined to keep vectors in registers, see `Polytope::add_face`.
#[inline(always)]
pub fn project_on_plane(v1: Vec3, v2: Vec3, v3: Vec3) -> Option<Vec3> {
    let (d21, d31, d32) = (sub(v2, v1), sub(v3, v1), sub(v3, v2));
    for (normal, v) in [(cross(d32, d21), v2), (cross(d21, d31), v1)] {
        let (height, norm2) = (dot(normal, v), dot(normal, normal));
        if norm2 == 0.0 {
            return None;
        }
        if height != 0.0 && norm2 > MINVAL {
            return Some(scale(normal, height / norm2));
        }
    }
    let normal = cross(d31, d32);
    Some(scale(normal, dot(normal, v3) / dot(normal, normal)))
}
