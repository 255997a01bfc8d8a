//! Volume, centre of mass and inertia of a triangle mesh, summed over the tetrahedra (or, for a shell,
//! the triangles) its faces span.

use crate::vector::{cross, dot, sub};
use physics::model::bounds::MINVAL;

/// How the interior of a mesh is weighed (`asset/mesh/inertia`).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum MeshInertia {
    /// Interior of the convex hull.
    Convex,
    /// Signed tetrahedra: exact for closed, consistently oriented meshes.
    Exact,
    /// Absolute tetrahedra: overestimates concave meshes, forgives bad orientation.
    #[default]
    Legacy,
    /// Mass on the surface.
    Shell,
}

pub(super) struct Triangle {
    /// Area in m².
    pub area: f64,
    /// Unit normal; not normalised when the triangle is degenerate.
    pub normal: [f64; 3],
    pub center: [f64; 3],
}

pub(super) fn triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Triangle {
    let center = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
    let n = cross(sub(b, a), sub(c, a));
    let length = dot(n, n).sqrt();
    if length < MINVAL {
        return Triangle { area: 0.0, normal: n, center };
    }
    Triangle { area: 0.5 * length, normal: n.map(|x| x / length), center }
}

fn corners(vert: &[[f64; 3]], face: [i32; 3]) -> [[f64; 3]; 3] {
    face.map(|v| vert[v as usize])
}

/// Total area and area-weighted centre of the faces.
pub(super) fn face_centroid(vert: &[[f64; 3]], face: &[[i32; 3]]) -> (f64, [f64; 3]) {
    let mut total = 0.0;
    let mut centroid = [0.0; 3];
    for &f in face {
        let [a, b, c] = corners(vert, f);
        let t = triangle(a, b, c);
        for k in 0..3 {
            centroid[k] += t.area * t.center[k];
        }
        total += t.area;
    }
    (total, divided(centroid, total))
}

/// Volume (or area) and centre of mass, with pyramids from `apex` over the faces.
pub(super) fn center_of_mass(
    vert: &[[f64; 3]],
    face: &[[i32; 3]],
    apex: [f64; 3],
    mode: MeshInertia,
) -> (f64, [f64; 3]) {
    let mut total = 0.0;
    let mut com = [0.0; 3];
    for &f in face {
        let [a, b, c] = corners(vert, f);
        let t = triangle(a, b, c);
        let weight = match mode {
            MeshInertia::Shell => t.area,
            MeshInertia::Legacy => (dot(sub(t.center, apex), t.normal) * t.area / 3.0).abs(),
            MeshInertia::Convex | MeshInertia::Exact => dot(sub(t.center, apex), t.normal) * t.area / 3.0,
        };
        total += weight;
        for k in 0..3 {
            com[k] += weight * (t.center[k] * 3.0 / 4.0 + apex[k] / 4.0);
        }
    }
    (total, divided(com, total))
}

fn divided(sum: [f64; 3], total: f64) -> [f64; 3] {
    if total >= MINVAL { sum.map(|x| x / total) } else { sum }
}

/// Volume (or area) and the symmetric inertia matrix at unit density about `com`.
pub(super) fn inertia(
    vert: &[[f64; 3]],
    face: &[[i32; 3]],
    com: [f64; 3],
    mode: MeshInertia,
) -> (f64, [f64; 9]) {
    const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
    let divisor = if mode == MeshInertia::Shell { 12.0 } else { 20.0 };
    let mut total = 0.0;
    let mut products = [0.0; 6];
    for &f in face {
        let [d, e, g] = corners(vert, f).map(|v| sub(v, com));
        let t = triangle(d, e, g);
        let weight = match mode {
            MeshInertia::Shell => t.area,
            MeshInertia::Legacy => (dot(t.center, t.normal) * t.area / 3.0).abs(),
            MeshInertia::Convex | MeshInertia::Exact => dot(t.center, t.normal) * t.area / 3.0,
        };
        total += weight;
        for (p, [j, k]) in products.iter_mut().zip(PAIRS) {
            *p += weight / divisor
                * (2.0 * (d[j] * d[k] + e[j] * e[k] + g[j] * g[k])
                    + d[j] * e[k]
                    + d[k] * e[j]
                    + d[j] * g[k]
                    + d[k] * g[j]
                    + e[j] * g[k]
                    + e[k] * g[j]);
        }
    }
    let [xx, yy, zz, xy, xz, yz] = products;
    (total, [yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy])
}
