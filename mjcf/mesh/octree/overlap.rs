//! Whether a triangle meets a box (M. Schwarz and H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs",
//! 2010).

use crate::vector::{cross, dot, sub};

/// Whether triangle `v` meets the box from the first to the last three numbers of `aamm`.
pub(super) fn overlaps(v: &[[f64; 3]; 3], aamm: &[f64; 6]) -> bool {
    let beside = |k: usize| v.iter().all(|p| p[k] < aamm[k]) || v.iter().all(|p| p[k] > aamm[k + 3]);
    if (0..3).any(beside) {
        return false;
    }
    let low = [aamm[0], aamm[1], aamm[2]];
    let size: [f64; 3] = std::array::from_fn(|k| aamm[k + 3] - aamm[k]);
    let edges: [[f64; 3]; 3] = std::array::from_fn(|i| sub(v[(i + 1) % 3], v[i]));
    let normal = cross(edges[0], edges[1]);
    plane_crosses(v[0], normal, low, size) && projections_overlap(v, &edges, normal, low, size)
}

/// The corners farthest along the normal and against it lie on different sides of the plane.
fn plane_crosses(p: [f64; 3], normal: [f64; 3], low: [f64; 3], size: [f64; 3]) -> bool {
    let far: [f64; 3] = std::array::from_fn(|k| if normal[k] > 0.0 { size[k] } else { 0.0 });
    let near: [f64; 3] = std::array::from_fn(|k| size[k] - far[k] - p[k]);
    let base = dot(normal, low);
    (base + dot(normal, sub(far, p))) * (base + dot(normal, near)) <= 0.0
}

/// Triangle and box overlap when seen along each axis.
fn projections_overlap(
    v: &[[f64; 3]; 3],
    edges: &[[f64; 3]; 3],
    normal: [f64; 3],
    low: [f64; 3],
    size: [f64; 3],
) -> bool {
    let positive = |x: f64| if 0.0 >= x { 0.0 } else { x };
    (0..3).all(|a| {
        let (b, c) = ((a + 1) % 3, (a + 2) % 3);
        let sign = if normal[a] >= 0.0 { 1.0 } else { -1.0 };
        (0..3).all(|i| {
            let inward = [-edges[i][c] * sign, edges[i][b] * sign];
            let offset = -(inward[0] * v[i][b] + inward[1] * v[i][c])
                + positive(size[b] * inward[0])
                + positive(size[c] * inward[1]);
            inward[0] * low[b] + inward[1] * low[c] + offset >= 0.0
        })
    })
}
