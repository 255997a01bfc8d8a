//! Contact normals of round geoms, recomputed from the point of contact: portal refinement returns normals of a
//! polyhedral approximation.

use super::shape::{PreContact, Shape};
use crate::math::clip;
use crate::math::{Vec3, add_scaled, distance, mul_mat_t_vec, mul_mat_vec, normalize, scale, sub};
use crate::model::GeomType;
use crate::model::bounds::MINVAL;

const MAX_ITERATIONS: usize = 30;
const TOLERANCE: f64 = 1e-6;

/// Corrects the normal of a contact between two geoms if one of them is round there; averages if both are.
pub fn correct(contact: &mut PreContact, first: &Shape, second: &Shape) {
    let n1 = surface_normal(first, contact.pos, contact.normal);
    let n2 = surface_normal(second, contact.pos, scale(contact.normal, -1.0));
    contact.normal = match (n1, n2) {
        (Some(n1), Some(n2)) => normalize(sub(n1, n2)).0,
        (Some(n1), None) => n1,
        (None, Some(n2)) => scale(n2, -1.0),
        (None, None) => return,
    };
}

/// Corrects the normal of a contact between a geom and something flat.
pub fn correct_first(contact: &mut PreContact, geom: &Shape) {
    if let Some(normal) = surface_normal(geom, contact.pos, contact.normal) {
        contact.normal = normal;
    }
}

/// Outward normal of a geom near `point`, from the guess `normal`; `None` where the geom is flat.
fn surface_normal(shape: &Shape, point: Vec3, normal: Vec3) -> Option<Vec3> {
    let p = mul_mat_t_vec(&shape.mat, sub(point, shape.pos));
    let guess = mul_mat_t_vec(&shape.mat, normal);
    let [radius, half, _] = shape.size;
    let local = match shape.kind {
        GeomType::Sphere => Some(p),
        GeomType::Capsule => Some([p[0], p[1], p[2] - clip(p[2], [-half, half])]),
        GeomType::Ellipsoid => ellipsoid_normal(p, guess, shape.size),
        GeomType::Cylinder => cylinder_normal(p, radius, half),
        _ => None,
    }?;
    Some(mul_mat_vec(&shape.mat, normalize(local).0))
}

/// Normal of the round wall; `None` near the flat ends, or where the wall is not four times nearer than they.
fn cylinder_normal(p: Vec3, radius: f64, half: f64) -> Option<Vec3> {
    let to_end = (half - p[2].abs()).abs();
    let to_wall = (radius - (p[0] * p[0] + p[1] * p[1]).sqrt()).abs();
    let at_wall = p[2].abs() <= 0.95 * half && to_end >= 0.25 * to_wall;
    at_wall.then_some([p[0], p[1], 0.0])
}

fn ellipsoid_normal(p: Vec3, guess: Vec3, size: Vec3) -> Option<Vec3> {
    if size.iter().any(|&s| s < MINVAL) {
        return None;
    }
    let level: f64 = p[0] * p[0] / (size[0] * size[0])
        + p[1] * p[1] / (size[1] * size[1])
        + p[2] * p[2] / (size[2] * size[2]);
    if level <= 1.0 { normal_from_inside(p, guess, size) } else { Some(normal_from_outside(p, size)) }
}

/// Follows the ray from `p` along the normal to the surface and takes the normal there, until it settles.
fn normal_from_inside(p: Vec3, guess: Vec3, size: Vec3) -> Option<Vec3> {
    let s = size.map(|s| 1.0 / (s * s));
    let c = p[0] * p[0] * s[0] + p[1] * p[1] * s[1] + p[2] * p[2] * s[2] - 1.0;
    if c > 0.0 {
        return None;
    }
    let (mut n, _) = normalize(guess);
    for iteration in 0..MAX_ITERATIONS {
        let a = n[0] * n[0] * s[0] + n[1] * n[1] * s[1] + n[2] * n[2] * s[2];
        let b = p[0] * n[0] * s[0] + p[1] * n[1] * s[1] + p[2] * n[2] * s[2];
        let det = b * b - a * c;
        let solvable = det >= MINVAL && a >= MINVAL;
        let length = if solvable { (-b + det.sqrt()) / a } else { -1.0 };
        if length < 0.0 {
            return (iteration > 0).then_some(n);
        }
        let hit = add_scaled(p, n, length);
        let (next, _) = normalize([hit[0] * s[0], hit[1] * s[1], hit[2] * s[2]]);
        let change = distance(n, next);
        n = next;
        if change < TOLERANCE {
            break;
        }
    }
    Some(n)
}

/// Normal at the surface point nearest to `p`, by Newton's method on the multiplier of its condition.
fn normal_from_outside(p: Vec3, size: Vec3) -> Vec3 {
    let s2 = size.map(|s| s * s);
    let ps2: Vec3 = std::array::from_fn(|i| p[i] * p[i] * s2[i]);
    let mut multiplier = 0.0;
    for _ in 0..MAX_ITERATIONS {
        let r = s2.map(|s| 1.0 / (s + multiplier));
        let value = ps2[0] * r[0] * r[0] + ps2[1] * r[1] * r[1] + ps2[2] * r[2] * r[2] - 1.0;
        if value < TOLERANCE {
            break;
        }
        let slope =
            -2.0 * (ps2[0] * r[0] * r[0] * r[0] + ps2[1] * r[1] * r[1] * r[1] + ps2[2] * r[2] * r[2] * r[2]);
        if slope > -MINVAL {
            break;
        }
        let step = -value / slope;
        if step < TOLERANCE {
            break;
        }
        multiplier += step;
    }
    std::array::from_fn(|i| p[i] / (s2[i] + multiplier))
}
