//! Penetration by Minkowski portal refinement (Snethen, Xenocollide: Complex Collision Made Simple, Game Programming
//! Gems 7, 2008): the algorithm of MuJoCo where its native one is disabled, with the tolerances and ties of the library
//! libccd.
//!
//! A ray leaves an inner point of the Minkowski difference toward the origin. A portal is a triangle of the difference
//! through which that ray passes. It is found by turning a wedge about the inner point, pushed outward until the
//! origin is behind it, and then on until it lies on the boundary: the origin's distance to it is the depth.

use super::gjk::{Limits, Vertex};
use super::support::ConvexBody;
use crate::math::{Vec3, add, add_scaled, cross, dot, norm, scale, sub};

/// Below this a number counts as zero.
const EPSILON: f64 = f64::EPSILON;
/// Bound on the two searches that would not end on bad numbers.
const MAX_STEPS: usize = 10_000;

/// Depth of two overlapping bodies.
#[derive(Clone, Copy, Debug)]
pub struct Overlap {
    /// Penetration depth, not negative \[m\].
    pub depth: f64,
    /// Direction in which the second body must move out; zero when the bodies only touch.
    pub direction: Vec3,
    /// Point of contact.
    pub pos: Vec3,
}

/// Overlap of two bodies; `None` when they are apart.
pub fn overlap(a: &mut ConvexBody, b: &mut ConvexBody, limits: &Limits) -> Option<Overlap> {
    let mut difference = Difference { a, b };
    let centre = difference.centre();
    let tip = difference.support_past_origin(unit(scale(centre.diff, -1.0)))?;
    let across = cross(centre.diff, tip.diff);
    if is_zero(dot(across, across)) {
        return Some(overlap_at(&tip));
    }
    let portal = difference.find_portal(centre, tip, unit(across))?;
    difference.push_out(portal, limits)
}

/// The overlap where the ray leaves the difference at a vertex.
fn overlap_at(tip: &Vertex) -> Overlap {
    let touching = tip.diff.into_iter().all(is_zero);
    Overlap {
        depth: if touching { 0.0 } else { norm(tip.diff) },
        direction: if touching { [0.0; 3] } else { unit(tip.diff) },
        pos: midpoint(tip.a, tip.b),
    }
}

/// The Minkowski difference of two bodies.
struct Difference<'s, 'a, 'b> {
    a: &'s mut ConvexBody<'a>,
    b: &'s mut ConvexBody<'b>,
}

impl Difference<'_, '_, '_> {
    /// An inner point that is not the origin.
    fn centre(&self) -> Vertex {
        let mut centre = difference(self.a.center(), self.b.center());
        if centre.diff.into_iter().all(is_zero) {
            centre.diff[0] += EPSILON * 10.0;
        }
        centre
    }

    fn support(&mut self, dir: Vec3) -> Vertex {
        difference(self.a.symmetric_support(dir), self.b.symmetric_support(scale(dir, -1.0)))
    }

    /// Support point in direction `dir`; `None` when it is not beyond the origin, and so nothing is.
    fn support_past_origin(&mut self, dir: Vec3) -> Option<Vertex> {
        let v = self.support(dir);
        (!at_most_zero(dot(v.diff, dir))).then_some(v)
    }

    /// Turns a wedge of `first` and the support point in direction `across` until it finds a portal; `None` when the
    /// origin is outside.
    fn find_portal(&mut self, centre: Vertex, first: Vertex, across: Vec3) -> Option<Portal> {
        let second = self.support_past_origin(across)?;
        let mut wedge = Wedge::toward_origin(centre, first, second);
        for _ in 0..MAX_STEPS {
            let v = self.support_past_origin(wedge.normal)?;
            match wedge.joined(v) {
                Joined::Portal(portal) => return Some(portal),
                Joined::Turned(turned) => wedge = turned,
            }
        }
        None
    }

    /// Pushes a portal to the boundary; `None` when the origin is beyond that.
    fn push_out(&mut self, mut portal: Portal, limits: &Limits) -> Option<Overlap> {
        let mut holds_origin = false;
        let mut steps = 0;
        loop {
            let dir = portal.outward();
            if !holds_origin && at_least_zero(dot(dir, portal.corners[0].diff)) {
                (holds_origin, steps) = (true, 0);
            }
            let v = self.support(dir);
            let arrived = portal.is_reached(&v, dir, limits.tolerance);
            if holds_origin {
                if arrived || steps > limits.iterations {
                    return Some(portal.overlap(dir));
                }
            } else if arrived || !at_least_zero(dot(v.diff, dir)) || steps == MAX_STEPS {
                return None;
            }
            portal.move_to(v);
            steps += 1;
        }
    }
}

/// The part of a plane between two rays from the inner point, with the origin on the side of the normal or in the plane.
struct Wedge {
    inner: Vertex,
    arms: [Vertex; 2],
    normal: Vec3,
}

enum Joined {
    Portal(Portal),
    Turned(Wedge),
}

impl Wedge {
    fn new(inner: Vertex, arms: [Vertex; 2]) -> Self {
        let [p, q] = arms.map(|arm| sub(arm.diff, inner.diff));
        Wedge { inner, arms, normal: unit(cross(p, q)) }
    }

    /// The wedge of two arms, in the order in which its normal looks toward the origin.
    fn toward_origin(inner: Vertex, first: Vertex, second: Vertex) -> Self {
        let wedge = Wedge::new(inner, [first, second]);
        if dot(wedge.normal, inner.diff) > 0.0 {
            Wedge { inner, arms: [second, first], normal: scale(wedge.normal, -1.0) }
        } else {
            wedge
        }
    }

    /// A portal of the arms and `v`, if the ray passes between them. Otherwise it leaves by the plane through `v` and
    /// one of the arms; `v` replaces the other.
    fn joined(self, v: Vertex) -> Joined {
        let Wedge { inner, arms: [p, q], .. } = self;
        let leaves_by = |from: &Vertex, to: &Vertex| {
            let volume = dot(cross(from.diff, to.diff), inner.diff);
            volume < 0.0 && !is_zero(volume)
        };
        if leaves_by(&p, &v) {
            Joined::Turned(Wedge::new(inner, [p, v]))
        } else if leaves_by(&v, &q) {
            Joined::Turned(Wedge::new(inner, [v, q]))
        } else {
            Joined::Portal(Portal { inner, corners: [p, q, v] })
        }
    }
}

/// An inner point and a triangle through which the ray from there to the origin passes. The corners go
/// counterclockwise seen from outside.
struct Portal {
    inner: Vertex,
    corners: [Vertex; 3],
}

impl Portal {
    /// Unit normal, away from the inner point.
    fn outward(&self) -> Vec3 {
        let [p, q, r] = self.corners.map(|corner| corner.diff);
        unit(cross(sub(q, p), sub(r, p)))
    }

    /// A support point along the normal is no farther out than a corner, within tolerance.
    fn is_reached(&self, v: &Vertex, normal: Vec3, tolerance: f64) -> bool {
        let top = dot(v.diff, normal);
        let [p, q, r] = self.corners.map(|corner| top - dot(corner.diff, normal));
        let gap = p.min(q).min(r);
        is_equal(gap, tolerance) || gap < tolerance
    }

    /// Makes `v` a corner such that the ray still passes. The plane through `v` and the ray leaves a corner or two on
    /// either side; `v` takes the place of one that the ray can do without.
    fn move_to(&mut self, v: Vertex) {
        let plane = cross(v.diff, self.inner.diff);
        let replaced = match self.corners.map(|corner| dot(corner.diff, plane) > 0.0) {
            [true, true, _] | [false, _, false] => 0,
            [false, _, true] => 1,
            [true, false, _] => 2,
        };
        self.corners[replaced] = v;
    }

    /// What a portal on the boundary says about the overlap. Takes its normal.
    fn overlap(&self, normal: Vec3) -> Overlap {
        let (foot, dist2) = nearest_in_triangle(self.corners.map(|corner| corner.diff));
        let depth = dist2.sqrt();
        let direction = if is_zero(depth) { [0.0; 3] } else { unit(foot) };
        Overlap { depth, direction, pos: self.contact_point(normal) }
    }

    /// The point of the bodies that the origin stands for: midway between the points of both with the weights that the
    /// vertices have for the origin in their tetrahedron, or for its projection in the triangle when the tetrahedron
    /// has no volume.
    fn contact_point(&self, normal: Vec3) -> Vec3 {
        let o = self.inner.diff;
        let [p, q, r] = self.corners.map(|corner| corner.diff);
        let volume = |a: Vec3, b: Vec3, c: Vec3| dot(cross(a, b), c);
        let mut inner = volume(p, q, r);
        let mut weights = [volume(r, q, o), volume(o, p, r), volume(q, p, o)];
        let mut sum = inner + weights[0] + weights[1] + weights[2];
        if at_most_zero(sum) {
            inner = 0.0;
            weights = [volume(q, r, normal), volume(r, p, normal), volume(p, q, normal)];
            sum = weights[0] + weights[1] + weights[2];
        }
        let mean = |point: fn(&Vertex) -> Vec3| {
            let mut mean = add_scaled([0.0; 3], point(&self.inner), inner);
            for (corner, weight) in self.corners.iter().zip(weights) {
                mean = add_scaled(mean, point(corner), weight);
            }
            scale(mean, 1.0 / sum)
        };
        midpoint(mean(|v| v.a), mean(|v| v.b))
    }
}

fn difference(a: Vec3, b: Vec3) -> Vertex {
    Vertex { diff: sub(a, b), a, b, index: [-1; 2] }
}

fn is_zero(x: f64) -> bool {
    x.abs() < EPSILON
}

fn is_equal(x: f64, y: f64) -> bool {
    let gap = (x - y).abs();
    gap < EPSILON || gap < EPSILON * x.abs().max(y.abs())
}

fn at_least_zero(x: f64) -> bool {
    is_zero(x) || x > 0.0
}

fn at_most_zero(x: f64) -> bool {
    is_zero(x) || x < 0.0
}

fn at_most_one(x: f64) -> bool {
    is_equal(x, 1.0) || x < 1.0
}

fn unit(v: Vec3) -> Vec3 {
    scale(v, 1.0 / norm(v))
}

fn midpoint(a: Vec3, b: Vec3) -> Vec3 {
    scale(add(a, b), 0.5)
}

/// Point of a segment nearest to the origin, and its squared distance.
fn nearest_in_segment(from: Vec3, to: Vec3) -> (Vec3, f64) {
    let along = sub(to, from);
    let foot = -dot(from, along) / dot(along, along);
    let point = if at_most_zero(foot) {
        from
    } else if is_equal(foot, 1.0) || foot > 1.0 {
        to
    } else {
        add(scale(along, foot), from)
    };
    (point, dot(point, point))
}

/// Point of a triangle nearest to the origin, and its squared distance: the foot of the perpendicular on its plane
/// when that lies within, or else a point of an edge.
fn nearest_in_triangle([p, q, r]: [Vec3; 3]) -> (Vec3, f64) {
    let edges = [sub(q, p), sub(r, p)];
    let (first2, second2, mixed) =
        (dot(edges[0], edges[0]), dot(edges[1], edges[1]), dot(edges[0], edges[1]));
    let gram = second2 * first2 - mixed * mixed;
    if !is_zero(gram) {
        // Normal equations of `p + s edges[0] + t edges[1]`.
        let [along_first, along_second] = edges.map(|edge| dot(p, edge));
        let s = (along_second * mixed - second2 * along_first) / gram;
        let t = (-s * mixed - along_second) / second2;
        if [s, t].into_iter().all(|x| at_least_zero(x) && at_most_one(x)) && at_most_one(t + s) {
            let point = add(add(p, scale(edges[0], s)), scale(edges[1], t));
            return (point, dot(point, point));
        }
    }
    let mut nearest = nearest_in_segment(p, q);
    for edge in [nearest_in_segment(p, r), nearest_in_segment(q, r)] {
        if edge.1 < nearest.1 {
            nearest = edge;
        }
    }
    nearest
}
