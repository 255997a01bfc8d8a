//! Rays against shapes with closed-form intersections, in the frame of the shape.

use super::hit::{LocalHit, Ray, keep_nearer};
use crate::math::{Vec3, dot, ops};
use crate::model::bounds::MINVAL;

/// Roots of `a x² + 2 b x + c`, in order; `None` when there are no two finite ones.
fn roots(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let det = b * b - a * c;
    if det < 0.0 || a < MINVAL {
        return None;
    }
    let root = ops::sqrt(det);
    Some([(-b - root) / a, (-b + root) / a])
}

/// Smallest root that is not negative.
fn first_root(a: f64, b: f64, c: f64) -> Option<f64> {
    roots(a, b, c)?.into_iter().find(|&x| x >= 0.0)
}

/// First root of the ray's distance to the z axis being `radius`.
fn first_on_tube(ray: &Ray, radius: f64) -> Option<f64> {
    let (o, d) = (ray.origin, ray.direction);
    first_root(
        d[0] * d[0] + d[1] * d[1],
        d[0] * o[0] + d[1] * o[1],
        o[0] * o[0] + o[1] * o[1] - radius * radius,
    )
}

/// Front side of the plane z = 0, within the rendered rectangle if the plane is finite.
pub(super) fn plane(size: Vec3, ray: Ray) -> Option<LocalHit> {
    if ray.direction[2] > -MINVAL {
        return None;
    }
    let distance = -ray.origin[2] / ray.direction[2];
    let p = ray.at(distance);
    let within = |k: usize| size[k] <= 0.0 || p[k].abs() <= size[k];
    (distance >= 0.0 && within(0) && within(1)).then_some(LocalHit { distance, normal: [0.0, 0.0, 1.0] })
}

pub(super) fn sphere(radius_squared: f64, ray: Ray) -> Option<LocalHit> {
    let (o, d) = (ray.origin, ray.direction);
    let distance = first_root(dot(d, d), dot(d, o), dot(o, o) - radius_squared)?;
    Some(LocalHit { distance, normal: ray.at(distance) })
}

/// A cylinder of half-length `size[1]` with half-spheres on its ends.
pub(super) fn capsule(size: Vec3, ray: Ray) -> Option<LocalHit> {
    let [radius, half, _] = size;
    sphere((radius + half) * (radius + half), ray)?;
    let mut best = None;
    if let Some(x) = first_on_tube(&ray, radius) {
        let p = ray.at(x);
        if p[2].abs() <= half {
            keep_nearer(&mut best, LocalHit { distance: x, normal: [p[0], p[1], 0.0] });
        }
    }
    for end in [1.0, -1.0] {
        let (o, d) = ([ray.origin[0], ray.origin[1], ray.origin[2] - end * half], ray.direction);
        let both = roots(dot(d, d), dot(d, o), dot(o, o) - radius * radius);
        for x in both.into_iter().flatten().filter(|&x| x >= 0.0) {
            let p = ray.at(x);
            if end * p[2] >= half {
                keep_nearer(&mut best, LocalHit { distance: x, normal: [p[0], p[1], p[2] - end * half] });
            }
        }
    }
    best
}

pub(super) fn ellipsoid(size: Vec3, ray: Ray) -> Option<LocalHit> {
    let s = size.map(|r| 1.0 / (r * r));
    let weighted = |a: Vec3, b: Vec3| s[0] * a[0] * b[0] + s[1] * a[1] * b[1] + s[2] * a[2] * b[2];
    let (o, d) = (ray.origin, ray.direction);
    let distance = first_root(weighted(d, d), weighted(d, o), weighted(o, o) - 1.0)?;
    let p = ray.at(distance);
    Some(LocalHit { distance, normal: [s[0] * p[0], s[1] * p[1], s[2] * p[2]] })
}

pub(super) fn cylinder(size: Vec3, ray: Ray) -> Option<LocalHit> {
    let [radius, half, _] = size;
    sphere(radius * radius + half * half, ray)?;
    let mut best = None;
    if ray.direction[2].abs() > MINVAL {
        for end in [-1.0, 1.0] {
            let x = (end * half - ray.origin[2]) / ray.direction[2];
            let p = ray.at(x);
            if x >= 0.0 && p[0] * p[0] + p[1] * p[1] <= radius * radius {
                keep_nearer(&mut best, LocalHit { distance: x, normal: [0.0, 0.0, end] });
            }
        }
    }
    if let Some(x) = first_on_tube(&ray, radius) {
        let p = ray.at(x);
        if p[2].abs() <= half {
            keep_nearer(&mut best, LocalHit { distance: x, normal: [p[0], p[1], 0.0] });
        }
    }
    best
}

pub(super) fn cuboid(size: Vec3, ray: Ray) -> Option<LocalHit> {
    cuboid_faces(size, ray).0
}

/// Nearest hit of a box, and the distance to each face that is hit, in the order -x +x -y +y -z +z.
pub(super) fn cuboid_faces(size: Vec3, ray: Ray) -> (Option<LocalHit>, [Option<f64>; 6]) {
    let (mut best, mut faces) = (None, [None; 6]);
    if sphere(dot(size, size), ray).is_none() {
        return (best, faces);
    }
    for axis in (0..3).filter(|&k| ray.direction[k].abs() > MINVAL) {
        let (u, v) = [(1, 2), (0, 2), (0, 1)][axis];
        for (face, side) in [(2 * axis, -1.0), (2 * axis + 1, 1.0)] {
            let x = (side * size[axis] - ray.origin[axis]) / ray.direction[axis];
            let p = ray.at(x);
            if x >= 0.0 && p[u].abs() <= size[u] && p[v].abs() <= size[v] {
                let mut normal = [0.0; 3];
                normal[axis] = side;
                keep_nearer(&mut best, LocalHit { distance: x, normal });
                faces[face] = Some(x);
            }
        }
    }
    (best, faces)
}
