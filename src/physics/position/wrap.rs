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
    /// Length of the curve on the surface [m].
    pub length: f64,
    /// First and last point of contact, world frame [m].
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

/// Arc that a string between two outer points lays on the circle: its length and end points.
fn arc_outside(end: [Vec2; 2], side: Option<Vec2>, radius: f64) -> Option<(f64, [Vec2; 2])> {
    let square = [dot2(end[0], end[0]), dot2(end[1], end[1])];
    let r2 = radius * radius;
    if square[0] < r2 || square[1] < r2 || radius < MINVAL {
        return None;
    }
    let dif = sub2(end[1], end[0]);
    let dd = dot2(dif, dif);
    if dd < MINVAL {
        return None;
    }
    let a = (-(dif[0] * end[0][0] + dif[1] * end[0][1]) / dd).clamp(0.0, 1.0);
    let nearest = [a * dif[0] + end[0][0], a * dif[1] + end[0][1]];
    if dot2(nearest, nearest) > r2 && side.is_none_or(|s| dot2(s, nearest) >= 0.0) {
        return None;
    }

    let root = [ops::sqrt(square[0] - r2), ops::sqrt(square[1] - r2)];
    let tangents = |sign: f64| {
        [
            [
                (end[0][0] * r2 + sign * radius * end[0][1] * root[0]) / square[0],
                (end[0][1] * r2 - sign * radius * end[0][0] * root[0]) / square[0],
            ],
            [
                (end[1][0] * r2 - sign * radius * end[1][1] * root[1]) / square[1],
                (end[1][1] * r2 + sign * radius * end[1][0] * root[1]) / square[1],
            ],
        ]
    };
    let (positive, negative) = (tangents(1.0), tangents(-1.0));
    let crosses = [positive, negative].map(|t| segments_intersect(end[0], t[0], end[1], t[1]));
    // With a side point, the tangent points nearer to it win; without one, the shorter chord.
    let merit = |t: [Vec2; 2], crosses: bool| {
        if crosses {
            return -10000.0;
        }
        match side {
            Some(s) => dot2(normalize2([t[0][0] + t[1][0], t[0][1] + t[1][1]]), s),
            None => {
                let chord = sub2(t[0], t[1]);
                -dot2(chord, chord)
            }
        }
    };
    let clockwise = merit(positive, crosses[0]) <= merit(negative, crosses[1]);
    let touch = if clockwise { negative } else { positive };
    if crosses[usize::from(clockwise)] {
        return None;
    }
    Some((arc_length(touch[0], touch[1], clockwise, radius), touch))
}

/// True when the segments `a0 a1` and `b0 b1` share a point.
fn segments_intersect(a0: Vec2, a1: Vec2, b0: Vec2, b1: Vec2) -> bool {
    let det = (b1[1] - b0[1]) * (a1[0] - a0[0]) - (b1[0] - b0[0]) * (a1[1] - a0[1]);
    if det.abs() < MINVAL {
        return false;
    }
    let s = ((b1[0] - b0[0]) * (a0[1] - b0[1]) - (b1[1] - b0[1]) * (a0[0] - b0[0])) / det;
    let t = ((a1[0] - a0[0]) * (a0[1] - b0[1]) - (a1[1] - a0[1]) * (a0[0] - b0[0])) / det;
    (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)
}

/// Length of the arc from `p0` to `p1`, in the given sense of turning.
fn arc_length(p0: Vec2, p1: Vec2, clockwise: bool, radius: f64) -> f64 {
    let mut angle = ops::acos(dot2(normalize2(p0), normalize2(p1)).min(1.0));
    let turn = p0[1] * p1[0] - p0[0] * p1[1];
    if (turn > 0.0 && clockwise) || (turn < 0.0 && !clockwise) {
        angle = 2.0 * PI - angle;
    }
    radius * angle
}

/// The point (given twice) where a string inside the circle touches it: the reflection point of the shortest path
/// between two outer points. `None` when the straight segment enters the circle.
fn touch_inside(end: [Vec2; 2], radius: f64) -> Option<[Vec2; 2]> {
    let length = [norm2(end[0]), norm2(end[1])];
    let dif = sub2(end[1], end[0]);
    let dd = dot2(dif, dif);
    if length[0] <= radius
        || length[1] <= radius
        || radius < MINVAL
        || length[0] < MINVAL
        || length[1] < MINVAL
    {
        return None;
    }
    if dd > MINVAL {
        let a = -(dif[0] * end[0][0] + dif[1] * end[0][1]) / dd;
        if a > 0.0 && a < 1.0 && norm2([end[0][0] + a * dif[0], end[0][1] + a * dif[1]]) <= radius {
            return None;
        }
    }
    let (a, b) = (radius / length[0], radius / length[1]);
    let cos_gap = (length[0] * length[0] + length[1] * length[1] - dd) / (2.0 * length[0] * length[1]);
    if cos_gap < -1.0 + MINVAL {
        return None;
    }
    let middle = [0.5 * (end[0][0] + end[1][0]), 0.5 * (end[0][1] + end[1][1])];
    let fallback = scale2(normalize2(middle), radius);
    let Some(z) = (cos_gap <= 1.0 - MINVAL).then(|| sine_at_touch(a, b, ops::acos(cos_gap))).flatten() else {
        return Some([fallback, fallback]);
    };
    let (from, angle) = if end[0][0] * end[1][1] - end[0][1] * end[1][0] > 0.0 {
        (end[0], ops::asin(z) - ops::asin(a * z))
    } else {
        (end[1], ops::asin(z) - ops::asin(b * z))
    };
    let v = normalize2(from);
    let (s, c) = (ops::sin(angle), ops::cos(angle));
    let touch = [radius * (c * v[0] - s * v[1]), radius * (s * v[0] + c * v[1])];
    Some([touch, touch])
}

/// Solves `asin(a z) + asin(b z) - 2 asin(z) + gap = 0` by Newton's method from just below 1; `None` when the
/// iteration does not approach the root from the right or does not converge.
fn sine_at_touch(a: f64, b: f64, gap: f64) -> Option<f64> {
    const ITERATIONS: usize = 20;
    const TOLERANCE: f64 = 1e-6;
    let residual = |z: f64| ops::asin(a * z) + ops::asin(b * z) - 2.0 * ops::asin(z) + gap;
    let mut z = 1.0 - 1e-7;
    let mut f = residual(z);
    if f > 0.0 {
        return None;
    }
    let mut iteration = 0;
    while iteration < ITERATIONS && f.abs() > TOLERANCE {
        let slope = a / ops::sqrt(1.0 - z * z * a * a).max(MINVAL)
            + b / ops::sqrt(1.0 - z * z * b * b).max(MINVAL)
            - 2.0 / ops::sqrt(1.0 - z * z).max(MINVAL);
        if slope > -MINVAL {
            return None;
        }
        let next = z - f / slope;
        if next > z {
            return None;
        }
        z = next;
        f = residual(z);
        if f > TOLERANCE {
            return None;
        }
        iteration += 1;
    }
    (iteration < ITERATIONS).then_some(z)
}

fn dot2(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
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
