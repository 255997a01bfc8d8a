//! Shortest path of a tendon around a sphere or a cylinder (documentation: Computation, "Tendon").
//!
//! The problem is reduced to a circle in the plane that holds the path (sphere) or is normal to the axis
//! (cylinder). A path outside the circle touches it along an arc; a path that must stay inside, because its
//! side site lies inside, touches it in one point that a Newton iteration finds.

use crate::math::{
    Mat3, Vec3, add, cross, dot, mul_mat_t_vec, mul_mat_vec, norm, normalize, ops, scale, sub,
};
use crate::model::bounds::MINVAL;
use std::f64::consts::PI;

/// A point in the plane of the circle.
type Vec2 = [f64; 2];

/// Where a tendon touches its wrapping geom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrap {
    /// Length of the curve on the surface \[m\].
    pub length: f64,
    /// First and last point of contact, world frame \[m\].
    pub points: [Vec3; 2],
}

/// Shape that a tendon wraps around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WrapShape {
    /// Sphere about the origin of the geom.
    Sphere,
    /// Infinite cylinder about the z axis of the geom.
    Cylinder,
}

/// Wraps the segment from `from` to `to` around a geom; `None` when the segment stays straight. A `side` point
/// outside the geom chooses the side on which to pass, one inside makes the path pass through the inside.
pub fn wrap(
    shape: WrapShape,
    radius: f64,
    center: Vec3,
    orientation: &Mat3,
    ends: [Vec3; 2],
    side: Option<Vec3>,
) -> Option<Wrap> {
    let local = |p: Vec3| mul_mat_t_vec(orientation, sub(p, center));
    let p = [local(ends[0]), local(ends[1])];
    if norm(p[0]) < MINVAL || norm(p[1]) < MINVAL {
        return None;
    }
    let plane = match shape {
        WrapShape::Sphere => plane_of_path(p[0], p[1]),
        WrapShape::Cylinder => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    };
    let project = |v: Vec3| [dot(v, plane[0]), dot(v, plane[1])];
    let end = [project(p[0]), project(p[1])];
    let side = side.map(local);
    let (mut length, touch) = match side {
        Some(s) if norm(s) < radius => (0.0, touch_inside(end, radius)?),
        _ => {
            let toward = side.map(|s| scale2(normalize2(project(s)), radius));
            arc_outside(end, toward, radius)?
        }
    };
    let mut q = touch.map(|t| add(scale(plane[0], t[0]), scale(plane[1], t[1])));
    if shape == WrapShape::Cylinder {
        length = rise_along_axis(p, &mut q, length);
    }
    Some(Wrap { length, points: q.map(|x| add(mul_mat_vec(orientation, x), center)) })
}

/// Orthonormal axes of the plane through the origin and both points, the first towards `p0`.
fn plane_of_path(p0: Vec3, p1: Vec3) -> [Vec3; 2] {
    let (x, _) = normalize(p0);
    let (mut normal, sine) = normalize(cross(p0, p1));
    if sine < MINVAL {
        // Both points on one line through the origin: any plane serves; leave out the largest component.
        let a = x.map(f64::abs);
        let largest = if a[2] > a[0] && a[2] > a[1] {
            2
        } else if a[1] > a[0] && a[1] > a[2] {
            1
        } else {
            0
        };
        let mut other = [1.0; 3];
        other[largest] = 0.0;
        normal = normalize(cross(x, other)).0;
    }
    [x, normalize(cross(normal, x)).0]
}

/// Gives the points on the cylinder their heights, which grow linearly with the length of the path in the plane,
/// and returns the length of the helix.
fn rise_along_axis(p: [Vec3; 2], q: &mut [Vec3; 2], arc: f64) -> f64 {
    let flat = |a: Vec3, b: Vec3| ops::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
    let (before, after) = (flat(p[0], q[0]), flat(p[1], q[1]));
    let (rise, total) = (p[1][2] - p[0][2], before + arc + after);
    q[0][2] = p[0][2] + rise * before / total;
    q[1][2] = p[0][2] + rise * (before + arc) / total;
    let height = (q[1][2] - q[0][2]).abs();
    ops::sqrt(arc * arc + height * height)
}

/// A string drawn straight between two points of the plane, seen from the centre of the circle.
struct Chord {
    ends: [Vec2; 2],
    /// From the first end to the second.
    along: Vec2,
    /// Squared length.
    length2: f64,
}

impl Chord {
    fn new(ends: [Vec2; 2]) -> Self {
        let along = sub2(ends[1], ends[0]);
        Chord { ends, along, length2: dot2(along, along) }
    }

    /// Foot of the perpendicular from the centre: 0 at the first end, 1 at the second.
    fn foot(&self) -> f64 {
        -dot2(self.along, self.ends[0]) / self.length2
    }

    /// The point at `t`, counted as [`Self::foot`] is.
    fn point(&self, t: f64) -> Vec2 {
        add2(scale2(self.along, t), self.ends[0])
    }
}

/// Sense in which a path goes around the circle.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    Clockwise,
    Counterclockwise,
}

/// A path outside the circle: along a tangent to the circle, around it, and away along another tangent.
struct Detour {
    turn: Turn,
    /// Where the tangents touch.
    touch: [Vec2; 2],
    /// The straight parts meet: no string lies like that.
    crosses_itself: bool,
}

/// Arc that a string between two outer points lays on the circle: its length and end points. `None` when the
/// straight string passes the circle, on the side that `toward` asks for.
fn arc_outside(ends: [Vec2; 2], toward: Option<Vec2>, radius: f64) -> Option<(f64, [Vec2; 2])> {
    let radius2 = radius * radius;
    let straight = Chord::new(ends);
    let tied_inside = ends.iter().any(|&end| dot2(end, end) < radius2);
    if tied_inside || radius < MINVAL || straight.length2 < MINVAL {
        return None;
    }
    let nearest = straight.point(straight.foot().clamp(0.0, 1.0));
    let passes = dot2(nearest, nearest) > radius2;
    if passes && toward.is_none_or(|side| dot2(side, nearest) >= 0.0) {
        return None;
    }
    let clockwise = Detour::new(ends, radius, Turn::Clockwise);
    let counterclockwise = Detour::new(ends, radius, Turn::Counterclockwise);
    let worse = clockwise.merit(toward) <= counterclockwise.merit(toward);
    let detour = if worse { counterclockwise } else { clockwise };
    (!detour.crosses_itself).then(|| (detour.arc_length(radius), detour.touch))
}

impl Detour {
    /// Turning clockwise, the string leaves its first end by the tangent that has the circle on the right, and
    /// reaches the second by the mirror image of such a tangent.
    #[inline(always)]
    fn new(ends: [Vec2; 2], radius: f64, turn: Turn) -> Self {
        let side = if turn == Turn::Clockwise { 1.0 } else { -1.0 };
        let touch = [point_of_tangency(ends[0], radius, side), point_of_tangency(ends[1], radius, -side)];
        let crosses_itself = segments_intersect([ends[0], touch[0]], [ends[1], touch[1]]);
        Detour { turn, touch, crosses_itself }
    }

    /// What makes a detour the better of the two: touching near the point asked for, or else touching at two points
    /// close together.
    fn merit(&self, toward: Option<Vec2>) -> f64 {
        /// Worse than any other merit on circles of less than 50 m.
        const CROSSED: f64 = -10000.0;
        let [first, last] = self.touch;
        match toward {
            _ if self.crosses_itself => CROSSED,
            Some(side) => dot2(normalize2(add2(first, last)), side),
            None => {
                let gap = sub2(first, last);
                -dot2(gap, gap)
            }
        }
    }

    /// Length of the arc between the points of tangency, in the sense of the detour.
    fn arc_length(&self, radius: f64) -> f64 {
        let [first, last] = self.touch;
        let shorter = ops::acos(dot2(normalize2(first), normalize2(last)).min(1.0));
        let rotation = cross2(first, last);
        let against = match self.turn {
            Turn::Clockwise => rotation > 0.0,
            Turn::Counterclockwise => rotation < 0.0,
        };
        radius * if against { 2.0 * PI - shorter } else { shorter }
    }
}

/// Where a tangent from an outer point touches the circle. With the point at distance `d` and its tangent of length
/// `l = √(d² - r²)`, the point of tangency is `r²/d` along the line from the centre and `r l/d` off it: clockwise of
/// that line for a `side` of 1, counterclockwise for -1.
fn point_of_tangency(from: Vec2, radius: f64, side: f64) -> Vec2 {
    let (radius2, distance2) = (radius * radius, dot2(from, from));
    let tangent = ops::sqrt(distance2 - radius2);
    let off = side * radius;
    [
        (from[0] * radius2 + off * from[1] * tangent) / distance2,
        (from[1] * radius2 - off * from[0] * tangent) / distance2,
    ]
}

/// True when two segments share a point; parallel ones do not.
fn segments_intersect(first: [Vec2; 2], second: [Vec2; 2]) -> bool {
    let (u, v) = (sub2(first[1], first[0]), sub2(second[1], second[0]));
    let offset = sub2(first[0], second[0]);
    let sine = cross2(u, v);
    // Cramer's rule on `first[0] + s u = second[0] + t v`.
    let within = |numerator: f64| (0.0..=1.0).contains(&(numerator / sine));
    sine.abs() >= MINVAL && within(cross2(v, offset)) && within(cross2(u, offset))
}

/// The point (given twice) where a string that must pass through the circle touches it from inside: the shortest
/// path over a point of the circle, which leaves that point at the angle at which it arrives, as light leaves a
/// mirror. `None` when the straight string enters the circle.
fn touch_inside(ends: [Vec2; 2], radius: f64) -> Option<[Vec2; 2]> {
    let straight = Chord::new(ends);
    let distance = ends.map(norm2);
    if radius < MINVAL || distance.iter().any(|&d| d <= radius) {
        return None;
    }
    let foot = straight.foot();
    let between = straight.length2 > MINVAL && foot > 0.0 && foot < 1.0;
    if between && norm2(straight.point(foot)) <= radius {
        return None;
    }
    let cos_gap = (distance[0] * distance[0] + distance[1] * distance[1] - straight.length2)
        / (2.0 * distance[0] * distance[1]);
    if cos_gap < -1.0 + MINVAL {
        return None;
    }
    let direction = (cos_gap <= 1.0 - MINVAL)
        .then(|| Reflection { ratio: distance.map(|d| radius / d), gap: ops::acos(cos_gap) })
        .and_then(|reflection| reflection.direction(ends))
        // Ends in one direction, or no convergence: the direction of the middle serves.
        .unwrap_or_else(|| normalize2(scale2(add2(ends[0], ends[1]), 0.5)));
    let touch = scale2(direction, radius);
    Some([touch, touch])
}

/// The law of reflection at a point of the circle that two ends outside see.
///
/// In the triangle of the centre, the point and an end at distance `d`, the sides `radius` and `d` are opposite the
/// angle at the end and the supplement of the angle of incidence `β`. By the law of sines the angle at the end is
/// `asin(z radius/d)` with `z = sin β`, which leaves `asin(z) - asin(z radius/d)` at the centre. The two angles at the
/// centre add up to the angle between the ends.
struct Reflection {
    /// Radius over the distance of each end from the centre.
    ratio: [f64; 2],
    /// Angle at the centre between the two ends.
    gap: f64,
}

impl Reflection {
    /// Direction of the point from the centre.
    fn direction(&self, ends: [Vec2; 2]) -> Option<Vec2> {
        let sine = self.sine_of_incidence()?;
        // Counterclockwise from the end that sees the other on its left.
        let start = if cross2(ends[0], ends[1]) > 0.0 { 0 } else { 1 };
        Some(rotate(normalize2(ends[start]), self.central_angle(start, sine)))
    }

    /// Angle at the centre between an end and the point.
    fn central_angle(&self, end: usize, sine: f64) -> f64 {
        ops::asin(sine) - ops::asin(self.ratio[end] * sine)
    }

    /// What of the gap the two angles at the centre leave open.
    fn misfit(&self, z: f64) -> f64 {
        ops::asin(self.ratio[0] * z) + ops::asin(self.ratio[1] * z) - 2.0 * ops::asin(z) + self.gap
    }

    /// Derivative of the misfit.
    fn slope(&self, z: f64) -> f64 {
        let cosine = |x2: f64| ops::sqrt(1.0 - x2).max(MINVAL);
        let [a, b] = self.ratio;
        a / cosine(z * z * a * a) + b / cosine(z * z * b * b) - 2.0 / cosine(z * z)
    }

    /// A trial of the sine of the angle of incidence.
    fn trial(&self, sine: f64) -> Trial {
        Trial { sine, misfit: self.misfit(sine) }
    }

    /// Root of the misfit, by Newton's method from just below grazing incidence.
    ///
    /// At 0 the misfit is the gap, which is positive. On (0, 1) it falls and is concave: its second derivative is the sum over
    /// both ratios `r` of `r³z / (1 - r²z²)^(3/2) - z / (1 - z²)^(3/2)`, which is negative for `r < 1`. A tangent of a concave
    /// function lies above it. So where the misfit is negative at the start, each step leads left and ends right of the root.
    /// `None` where it is not negative there, where rounding spoils this order, or where the steps do not suffice.
    fn sine_of_incidence(&self) -> Option<f64> {
        const START: f64 = 1.0 - 1e-7;
        const STEPS: usize = 20;
        let mut trial = self.trial(START);
        if trial.misfit > 0.0 {
            return None;
        }
        for _ in 0..STEPS {
            if trial.is_root() {
                return Some(trial.sine);
            }
            trial = self.newton(&trial)?;
        }
        None
    }

    /// The trial to the left that Newton's step leads to; `None` where it does not lead left, or beyond the root.
    fn newton(&self, trial: &Trial) -> Option<Trial> {
        let slope = self.slope(trial.sine);
        let sine = trial.sine - trial.misfit / slope;
        if slope > -MINVAL || sine > trial.sine {
            return None;
        }
        let next = self.trial(sine);
        (next.misfit <= Trial::TOLERANCE).then_some(next)
    }
}

/// A sine of the angle of incidence, and by how much it misses the law of reflection.
struct Trial {
    sine: f64,
    misfit: f64,
}

impl Trial {
    /// Angle at the centre up to which the law holds \[rad\].
    const TOLERANCE: f64 = 1e-6;

    fn is_root(&self) -> bool {
        self.misfit.abs() <= Self::TOLERANCE
    }
}

/// Component of the vector product normal to the plane: positive when `b` is to the left of `a`.
fn cross2(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `v` turned counterclockwise.
fn rotate(v: Vec2, angle: f64) -> Vec2 {
    let (s, c) = (ops::sin(angle), ops::cos(angle));
    [c * v[0] - s * v[1], s * v[0] + c * v[1]]
}

fn dot2(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn add2(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] + b[0], a[1] + b[1]]
}

fn sub2(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

fn scale2(a: Vec2, s: f64) -> Vec2 {
    [a[0] * s, a[1] * s]
}

fn norm2(a: Vec2) -> f64 {
    ops::sqrt(dot2(a, a))
}

fn normalize2(a: Vec2) -> Vec2 {
    let n = norm2(a);
    if n < MINVAL { [1.0, 0.0] } else { scale2(a, 1.0 / n) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

    #[test]
    fn string_over_sphere_has_closed_form_length() {
        let (r, x, y) = (0.3, 0.5, 0.1);
        let w = wrap(WrapShape::Sphere, r, [0.0; 3], &UPRIGHT, [[-x, y, 0.0], [x, y, 0.0]], None).unwrap();
        let total = norm(sub(w.points[0], [-x, y, 0.0])) + w.length + norm(sub(w.points[1], [x, y, 0.0]));
        let far = (x * x + y * y).sqrt();
        let expected = 2.0 * (far * far - r * r).sqrt() + r * (2.0 * (x / y).atan() - 2.0 * (r / far).acos());
        assert!((total - expected).abs() < 1e-12, "{total} {expected}");
        assert!(w.points.iter().all(|p| (norm(*p) - r).abs() < 1e-12));
    }

    /// Ends below the sphere, a side site above it: the tangents touch at the angle `atan(x/y) + acos(r/far)` from below.
    #[test]
    fn string_over_the_far_side_covers_more_than_half_the_circle() {
        let (r, x, y) = (0.3_f64, 0.2_f64, 0.5_f64);
        let ends = [[-x, -y, 0.0], [x, -y, 0.0]];
        let far = (x * x + y * y).sqrt();
        let expected = r * (2.0 * PI - 2.0 * ((x / y).atan() + (r / far).acos()));
        assert!(expected > r * PI);
        for ends in [ends, [ends[1], ends[0]]] {
            let w = wrap(WrapShape::Sphere, r, [0.0; 3], &UPRIGHT, ends, Some([0.0, 0.4, 0.0])).unwrap();
            assert!((w.length - expected).abs() < 1e-12, "{} {expected}", w.length);
        }
    }

    #[test]
    fn helix_meets_cylinder_at_constant_slope() {
        let ends = [[-0.5, 0.1, -0.2], [0.5, 0.1, 0.4]];
        let w = wrap(WrapShape::Cylinder, 0.3, [0.0; 3], &UPRIGHT, ends, None).unwrap();
        let slope = |a: Vec3, b: Vec3| (b[2] - a[2]) / norm([b[0] - a[0], b[1] - a[1], 0.0]);
        let (before, after) = (slope(ends[0], w.points[0]), slope(w.points[1], ends[1]));
        assert!((before - after).abs() < 1e-12 && before > 0.1);
        let rise = w.points[1][2] - w.points[0][2];
        assert!((rise / (w.length * w.length - rise * rise).sqrt() - before).abs() < 1e-12);
    }

    #[test]
    fn inside_path_reflects_at_equal_angles() {
        let ends = [[-0.5, 0.6, 0.0], [0.7, 0.4, 0.0]];
        let w = wrap(WrapShape::Sphere, 0.3, [0.0; 3], &UPRIGHT, ends, Some([0.0, 0.01, 0.0])).unwrap();
        assert_eq!((w.length, w.points[0]), (0.0, w.points[1]));
        let normal = normalize(w.points[0]).0;
        let angles = ends.map(|e| dot(normalize(sub(e, w.points[0])).0, normal));
        // The iteration stops at 1e-6.
        assert!((angles[0] - angles[1]).abs() < 1e-5 && angles[0] > 0.1, "{angles:?}");
    }
}
