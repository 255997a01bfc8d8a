//! Penetration by Minkowski portal refinement, as the library libccd does it: the algorithm that MuJoCo uses when
//! its native one is disabled (Snethen, Xenocollide: Complex Collision Made Simple, Game Programming Gems 7, 2008).
//!
//! A portal is a triangle of the Minkowski difference through which the ray from an interior point to the origin
//! passes. It is pushed outward until it holds the origin, then until it lies on the boundary.

use super::gjk::{Limits, Vertex};
use super::support::ConvexBody;
use crate::math::{Vec3, add, add_scaled, cross, dot, norm, scale, sub};

/// Below this a number counts as zero.
const EPSILON: f64 = f64::EPSILON;
/// Bound on the two searches that have none in libccd and would not end on bad numbers.
const MAX_STEPS: usize = 10_000;

/// Depth of two overlapping bodies.
#[derive(Clone, Copy, Debug)]
pub struct Overlap {
    /// Penetration depth, not negative [m].
    pub depth: f64,
    /// Direction in which the second body must move out; zero when the bodies only touch.
    pub direction: Vec3,
    /// Point of contact.
    pub pos: Vec3,
}

/// An interior point (0) and a triangle that faces away from it (1, 2, 3).
type Portal = [Vertex; 4];

enum Discovery {
    Apart,
    /// The origin lies on vertex 1.
    OnVertex(Portal),
    /// The origin lies between the interior point and vertex 1.
    OnSegment(Portal),
    Found(Portal),
}

/// Overlap of two bodies; `None` when they are apart.
pub fn overlap(a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits) -> Option<Overlap> {
    match discover(a, b) {
        Discovery::Apart => None,
        Discovery::OnVertex(portal) => {
            Some(Overlap { depth: 0.0, direction: [0.0; 3], pos: midpoint(portal[1].a, portal[1].b) })
        }
        Discovery::OnSegment(portal) => {
            let v = portal[1].diff;
            Some(Overlap { depth: norm(v), direction: unit(v), pos: midpoint(portal[1].a, portal[1].b) })
        }
        Discovery::Found(mut portal) => {
            let holds_origin = refine(a, b, limits, &mut portal);
            holds_origin.then(|| push_to_surface(a, b, limits, portal))
        }
    }
}

fn support(a: &mut ConvexBody, b: &mut ConvexBody, dir: Vec3) -> Vertex {
    let pa = a.symmetric_support(dir);
    let pb = b.symmetric_support(scale(dir, -1.0));
    Vertex { diff: sub(pa, pb), a: pa, b: pb, index: [-1; 2] }
}

fn is_zero(x: f64) -> bool {
    x.abs() < EPSILON
}

fn is_equal(x: f64, y: f64) -> bool {
    let gap = (x - y).abs();
    gap < EPSILON || gap < EPSILON * x.abs().max(y.abs())
}

fn at_origin(v: Vec3) -> bool {
    v.iter().all(|&x| is_equal(x, 0.0))
}

fn unit(v: Vec3) -> Vec3 {
    scale(v, 1.0 / norm(v))
}

fn midpoint(a: Vec3, b: Vec3) -> Vec3 {
    scale(add(a, b), 0.5)
}

/// The support point `v` in direction `dir` is not beyond the origin.
fn falls_short(v: &Vertex, dir: Vec3) -> bool {
    let reach = dot(v.diff, dir);
    is_zero(reach) || reach < 0.0
}

/// Finds a portal, or that there is none.
fn discover(a: &mut ConvexBody, b: &mut ConvexBody) -> Discovery {
    let (center_a, center_b) = (a.center(), b.center());
    let mut v0 = Vertex { diff: sub(center_a, center_b), a: center_a, b: center_b, index: [-1; 2] };
    if at_origin(v0.diff) {
        v0.diff[0] += EPSILON * 10.0;
    }
    let dir = unit(scale(v0.diff, -1.0));
    let mut v1 = support(a, b, dir);
    if falls_short(&v1, dir) {
        return Discovery::Apart;
    }
    let side = cross(v0.diff, v1.diff);
    if is_zero(dot(side, side)) {
        let portal = [v0, v1, v1, v1];
        return if at_origin(v1.diff) { Discovery::OnVertex(portal) } else { Discovery::OnSegment(portal) };
    }
    let dir = unit(side);
    let mut v2 = support(a, b, dir);
    if falls_short(&v2, dir) {
        return Discovery::Apart;
    }
    let mut dir = unit(cross(sub(v1.diff, v0.diff), sub(v2.diff, v0.diff)));
    if dot(dir, v0.diff) > 0.0 {
        (v1, v2) = (v2, v1);
        dir = scale(dir, -1.0);
    }
    for _ in 0..MAX_STEPS {
        let v3 = support(a, b, dir);
        if falls_short(&v3, dir) {
            return Discovery::Apart;
        }
        // The third vertex replaces the one whose side the ray to the origin passes by.
        let beyond = |volume: f64| volume < 0.0 && !is_zero(volume);
        if beyond(dot(cross(v1.diff, v3.diff), v0.diff)) {
            v2 = v3;
        } else if beyond(dot(cross(v3.diff, v2.diff), v0.diff)) {
            v1 = v3;
        } else {
            return Discovery::Found([v0, v1, v2, v3]);
        }
        dir = unit(cross(sub(v1.diff, v0.diff), sub(v2.diff, v0.diff)));
    }
    Discovery::Apart
}

/// Normal of the portal, away from the interior point.
fn outward(portal: &Portal) -> Vec3 {
    let [_, v1, v2, v3] = portal;
    unit(cross(sub(v2.diff, v1.diff), sub(v3.diff, v1.diff)))
}

/// Pushes the portal outward until the origin is behind it; false when it never will be.
fn refine(a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits, portal: &mut Portal) -> bool {
    for _ in 0..MAX_STEPS {
        let dir = outward(portal);
        let height = dot(dir, portal[1].diff);
        if is_zero(height) || height > 0.0 {
            return true;
        }
        let v4 = support(a, b, dir);
        let reach = dot(v4.diff, dir);
        let can_hold_origin = is_zero(reach) || reach > 0.0;
        if !can_hold_origin || is_on_surface(portal, &v4, dir, limits.tolerance) {
            return false;
        }
        expand(portal, v4);
    }
    false
}

/// The support point in direction `dir` is no farther than the portal, within tolerance.
fn is_on_surface(portal: &Portal, v4: &Vertex, dir: Vec3, tolerance: f64) -> bool {
    let top = dot(v4.diff, dir);
    let gap = |v: &Vertex| top - dot(v.diff, dir);
    let least = gap(&portal[1]).min(gap(&portal[2])).min(gap(&portal[3]));
    is_equal(least, tolerance) || least < tolerance
}

/// Replaces the vertex of the portal such that the ray to the origin still passes through.
fn expand(portal: &mut Portal, v4: Vertex) {
    let side = cross(v4.diff, portal[0].diff);
    let replaced = if dot(portal[1].diff, side) > 0.0 {
        if dot(portal[2].diff, side) > 0.0 { 1 } else { 3 }
    } else if dot(portal[3].diff, side) > 0.0 {
        2
    } else {
        1
    };
    portal[replaced] = v4;
}

/// Pushes the portal to the boundary of the Minkowski difference and measures the depth of the origin there.
fn push_to_surface(a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits, mut portal: Portal) -> Overlap {
    let mut iterations = 0;
    loop {
        let dir = outward(&portal);
        let v4 = support(a, b, dir);
        if is_on_surface(&portal, &v4, dir, limits.tolerance) || iterations > limits.iterations {
            let [_, v1, v2, v3] = portal.map(|v| v.diff);
            let (foot, dist2) = nearest_in_triangle(v1, v2, v3);
            let depth = dist2.sqrt();
            let direction = if is_zero(depth) { [0.0; 3] } else { unit(foot) };
            return Overlap { depth, direction, pos: contact_point(&portal, dir) };
        }
        expand(&mut portal, v4);
        iterations += 1;
    }
}

/// The origin in barycentric coordinates of the portal's tetrahedron, or else of its triangle, taken to both bodies.
fn contact_point(portal: &Portal, dir: Vec3) -> Vec3 {
    let [v0, v1, v2, v3] = portal.map(|v| v.diff);
    let triple = |a: Vec3, b: Vec3, c: Vec3| dot(cross(a, b), c);
    let mut weight = [triple(v1, v2, v3), triple(v3, v2, v0), triple(v0, v1, v3), triple(v2, v1, v0)];
    let mut sum = weight[0] + weight[1] + weight[2] + weight[3];
    if is_zero(sum) || sum < 0.0 {
        weight = [0.0, triple(v2, v3, dir), triple(v3, v1, dir), triple(v1, v2, dir)];
        sum = weight[1] + weight[2] + weight[3];
    }
    let inverse = 1.0 / sum;
    let (mut pa, mut pb) = ([0.0; 3], [0.0; 3]);
    for (v, w) in portal.iter().zip(weight) {
        pa = add_scaled(pa, v.a, w);
        pb = add_scaled(pb, v.b, w);
    }
    midpoint(scale(pa, inverse), scale(pb, inverse))
}

/// Point of a segment nearest to the origin, and its squared distance.
fn nearest_in_segment(a: Vec3, b: Vec3) -> (Vec3, f64) {
    let d = sub(b, a);
    let t = -dot(a, d) / dot(d, d);
    let point = if t < 0.0 || is_zero(t) {
        a
    } else if t > 1.0 || is_equal(t, 1.0) {
        b
    } else {
        add(scale(d, t), a)
    };
    (point, dot(point, point))
}

/// Point of a triangle nearest to the origin, and its squared distance.
fn nearest_in_triangle(a: Vec3, b: Vec3, c: Vec3) -> (Vec3, f64) {
    let (d1, d2) = (sub(b, a), sub(c, a));
    let (v, w, r) = (dot(d1, d1), dot(d2, d2), dot(d1, d2));
    let (p, q) = (dot(a, d1), dot(a, d2));
    let det = w * v - r * r;
    if !is_zero(det) {
        let s = (q * r - w * p) / det;
        let t = (-s * r - q) / w;
        let not_negative = |x: f64| is_zero(x) || x > 0.0;
        let at_most_one = |x: f64| is_equal(x, 1.0) || x < 1.0;
        if not_negative(s) && at_most_one(s) && not_negative(t) && at_most_one(t) && at_most_one(t + s) {
            let point = add(add(a, scale(d1, s)), scale(d2, t));
            return (point, dot(point, point));
        }
    }
    let mut best = nearest_in_segment(a, b);
    for other in [nearest_in_segment(a, c), nearest_in_segment(b, c)] {
        if other.1 < best.1 {
            best = other;
        }
    }
    best
}
