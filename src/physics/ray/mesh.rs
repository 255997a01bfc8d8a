//! Rays against triangles, and against meshes through their bounding volume hierarchy.

use super::hit::{LocalHit, Ray, keep_nearer};
use crate::geometry::hierarchy::MAX_LEVELS;
use crate::math::{Vec3, add_scaled, cross, dot, normalize, sub};
use crate::model::Model;
use crate::model::bounds::MINVAL;

/// Two axes across a ray, on which triangles are projected.
pub(super) fn across(direction: Vec3) -> [Vec3; 2] {
    let a = direction.map(f64::abs);
    let mut start = [1.0; 3];
    let largest = if a[0] >= a[1] && a[0] >= a[2] {
        0
    } else if a[1] >= a[2] {
        1
    } else {
        2
    };
    start[largest] = 0.0;
    let b1 = normalize(add_scaled(start, direction, -dot(direction, start) / dot(direction, direction))).0;
    [normalize(cross(b1, direction)).0, b1]
}

/// Where the line of `ray`, projected on `axes`, passes through a triangle; may lie behind the origin.
pub(super) fn triangle(v: [Vec3; 3], ray: &Ray, axes: &[Vec3; 2]) -> Option<LocalHit> {
    let planar = v.map(|p| {
        let dif = sub(p, ray.origin);
        [dot(axes[0], dif), dot(axes[1], dif)]
    });
    for k in 0..2 {
        let side = planar.map(|p| p[k]);
        if side.iter().all(|&x| x > 0.0) || side.iter().all(|&x| x < 0.0) {
            return None;
        }
    }
    let [p0, p1, p2] = planar;
    let a = [p0[0] - p2[0], p1[0] - p2[0], p0[1] - p2[1], p1[1] - p2[1]];
    let det = a[0] * a[3] - a[1] * a[2];
    if det.abs() < MINVAL {
        return None;
    }
    let t0 = (a[3] * -p2[0] - a[1] * -p2[1]) / det;
    let t1 = (-a[2] * -p2[0] + a[0] * -p2[1]) / det;
    if t0 < 0.0 || t1 < 0.0 || t0 + t1 > 1.0 {
        return None;
    }
    let normal = cross(sub(v[0], v[2]), sub(v[1], v[2]));
    let slope = dot(ray.direction, normal);
    if slope.abs() < MINVAL {
        return None;
    }
    Some(LocalHit { distance: -dot(sub(ray.origin, v[2]), normal) / slope, normal })
}

/// Nearest face of mesh `id`, in the frame of the mesh.
pub(super) fn mesh(m: &Model, id: usize, ray: Ray) -> Option<LocalHit> {
    let root = usize::try_from(m.mesh_bvhadr[id]).ok()?;
    let (first_face, first_vertex) = (m.mesh_faceadr[id] as usize, m.mesh_vertadr[id] as usize);
    let axes = across(ray.direction);
    let mut best = None;
    let (mut stack, mut depth) = ([0_usize; MAX_LEVELS], 1);
    while depth > 0 {
        depth -= 1;
        let node = root + stack[depth];
        if !enters(&m.bvh_aabb[node], &ray) {
            continue;
        }
        if let Ok(face) = usize::try_from(m.bvh_nodeid[node]) {
            let corners =
                m.mesh_face[first_face + face].map(|k| m.mesh_vert[first_vertex + k as usize].map(f64::from));
            if let Some(hit) = triangle(corners, &ray, &axes).filter(|hit| hit.distance >= 0.0) {
                keep_nearer(&mut best, hit);
            }
            continue;
        }
        for child in m.bvh_child[node].iter().filter_map(|&c| usize::try_from(c).ok()) {
            stack[depth] = child;
            depth += 1;
        }
    }
    best
}

/// Slab test of a box, given as centre and half-sizes (Ericson 2005, section 5.3.3). Comparisons are arranged so
/// that the NaN of a ray within a face plane does not count.
fn enters(aabb: &[f64; 6], ray: &Ray) -> bool {
    let (mut near, mut far) = (0.0, f64::INFINITY);
    for k in 0..3 {
        let inverse = 1.0 / ray.direction[k];
        let t1 = (aabb[k] - aabb[k + 3] - ray.origin[k]) * inverse;
        let t2 = (aabb[k] + aabb[k + 3] - ray.origin[k]) * inverse;
        let (low, high) = if t1 < t2 { (t1, t2) } else { (t2, t1) };
        near = if near > low { near } else { low };
        far = if far < high { far } else { high };
    }
    near < far
}
