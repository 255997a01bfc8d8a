//! Distance between convex bodies: the Gilbert–Johnson–Keerthi algorithm with signed volumes
//! (Montanari, Petrinic and Barbieri, Improving the GJK Algorithm, ACM TOG 36, 2017).
//!
//! GJK walks simplices of the Minkowski difference `A - B` toward the origin. Where only contact matters, a
//! tetrahedron is turned toward the origin face by face, until it holds the origin or a face shows it outside.

use super::support::ConvexBody;
use crate::math::{Vec3, add_scaled, cross, dot, norm, scale, sub};
use crate::model::bounds::{MAXVAL, MINVAL};

/// Value of a distance that is not known, only greater than the cut-off.
pub const BEYOND: f64 = f64::MAX;

/// Bounds on the work of GJK and of polytope expansion.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most iterations of each algorithm.
    pub iterations: usize,
    /// Tolerance on distance and depth [m].
    pub tolerance: f64,
    /// Distances are wanted up to here; 0 asks only whether the bodies touch [m].
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
    /// Distance; [`BEYOND`] past the cut-off; 0 when a tetrahedron holds the origin [m].
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
    let discrete = a.is_discrete() && b.is_discrete();
    // Polytopes end after finitely many steps, so nothing but rounding needs a tolerance.
    let gap_tolerance = if discrete { 0.0 } else { 0.5 * (limits.tolerance * limits.tolerance) };
    let touching = if discrete { MINVAL } else { limits.tolerance };
    let mut try_enclosing = limits.cutoff <= 0.0;

    let mut lambda = [0.0; 4];
    let mut nearest = [a.center(), b.center()];
    let mut x = sub(nearest[0], nearest[1]);
    let (mut x_norm, mut x_norm_before) = (norm(x), 0.0_f64);
    let (mut n, mut k) = (0, 0);
    let mut farthest = None;
    while k < limits.iterations {
        if x_norm < touching || (x_norm_before - x_norm).abs() < MINVAL {
            break;
        }
        support(a, b, toward_origin(x, x_norm), &mut simplex[n]);
        let s = simplex[n].diff;
        // Frank–Wolfe duality gap: an upper bound on |x - x_min|².
        if dot(x, sub(x, s)) < gap_tolerance {
            farthest = Some(s);
            break;
        }
        // A support plane at this distance times |x| has the origin in front of it.
        let lower = dot(x, s);
        if lower > 0.0 && is_beyond(lower, x_norm, limits.cutoff) {
            return APART;
        }
        if n == 3 && try_enclosing {
            match enclose_origin(a, b, simplex, &mut k, limits.iterations) {
                Enclosure::Inside => {
                    return Proximity { dist: 0.0, separated: false, n: 4, nearest: None };
                }
                Enclosure::Outside => return APART,
                Enclosure::Unknown => try_enclosing = false,
            }
        }
        lambda = barycentric(simplex, n + 1);
        n = drop_unused(simplex, &mut lambda);
        if n == 0 {
            return APART;
        }
        x = combine(&lambda, n, |i| simplex[i].diff);
        x_norm_before = x_norm;
        x_norm = norm(x);
        if n == 4 {
            break;
        }
        k += 1;
    }

    if n > 0 {
        nearest = [combine(&lambda, n, |i| simplex[i].a), combine(&lambda, n, |i| simplex[i].b)];
    }
    let farthest = farthest.unwrap_or_else(|| {
        let mut last = Vertex::default();
        support(a, b, toward_origin(x, x_norm), &mut last);
        last.diff
    });
    let separated = dot(x, farthest) > 0.0;
    let dist = if n == 4 && !separated { 0.0 } else { x_norm };
    Proximity { dist, separated, n, nearest: Some(nearest) }
}

/// Compares `lower / x_norm` with the cut-off, in squares: exact ties decide as in MuJoCo's release.
fn is_beyond(lower: f64, x_norm: f64, cutoff: f64) -> bool {
    cutoff <= 0.0 || (cutoff < BEYOND && lower * lower >= x_norm * x_norm * (cutoff * cutoff))
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

enum Enclosure {
    Inside,
    Outside,
    Unknown,
}

/// Turns a tetrahedron until it holds the origin: the vertex opposite the face nearest to the origin, or most
/// beyond it, gives way to a support point of that face. `k` counts iterations. A simplex of which nothing is known
/// stays.
fn enclose_origin(
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    simplex: &mut [Vertex; 4],
    k: &mut usize,
    iterations: usize,
) -> Enclosure {
    let mut before = None;
    while *k < iterations {
        let [v1, v2, v3, v4] = diffs(simplex);
        let faces = [
            oriented_distance(v3, v2, v4),
            oriented_distance(v1, v3, v4),
            oriented_distance(v2, v1, v4),
            oriented_distance(v1, v2, v3),
        ];
        let dist = faces.map(|f| f.1);
        if dist.contains(&0.0) {
            break;
        }
        let i = if dist[0] < dist[1] { 0 } else { 1 };
        let j = if dist[2] < dist[3] { 2 } else { 3 };
        let worst = if dist[i] < dist[j] { i } else { j };
        if dist[worst] > 0.0 {
            return Enclosure::Inside;
        }
        before = before.or(Some(*simplex));
        let normal = faces[worst].0;
        support(a, b, normal, &mut simplex[worst]);
        if dot(normal, simplex[worst].diff) < 0.0 {
            return Enclosure::Outside;
        }
        simplex.swap((worst + 1) % 4, (worst + 2) % 4);
        *k += 1;
    }
    *simplex = before.unwrap_or(*simplex);
    Enclosure::Unknown
}

/// Normal of a face and its distance from the origin; [`BEYOND`] for a face without area.
// Inlined to keep vectors in registers, see `Polytope::add_face`.
#[inline(always)]
fn oriented_distance(v1: Vec3, v2: Vec3, v3: Vec3) -> (Vec3, f64) {
    let normal = cross(sub(v3, v1), sub(v2, v1));
    let norm2 = dot(normal, normal);
    if norm2 > MINVAL * MINVAL && norm2 < MAXVAL * MAXVAL {
        let unit = scale(normal, 1.0 / norm2.sqrt());
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
