//! Octrees that interpolate the signed distance from a mesh.
//!
//! Cells that triangles meet are split down to a depth, then neighbours until their depths differ by one at most. A corner
//! in the middle of a larger neighbour's face or edge takes the mean of the corners there, so that the distance is
//! continuous. Cells are numbered as they are made; corners of a cell by bits x, y, z.

mod cells;
mod distance;
mod overlap;

use cells::Cells;
use distance::Surface;
use physics::geometry::hierarchy::Bvh;
use std::collections::VecDeque;

/// `oct_*` rows of one mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Octree {
    /// `oct_depth`.
    pub depth: Vec<i32>,
    /// `oct_child`, counted from the first cell of the mesh; -1 for none.
    pub child: Vec<[i32; 8]>,
    /// `oct_aabb`: centre, half sizes.
    pub aabb: Vec<[f64; 6]>,
    /// `oct_coeff`: distances at the corners.
    pub coeff: Vec<[f64; 8]>,
}

/// The octree around a mesh within `aamm` (minimum, maximum).
pub(super) fn build(
    vert: &[[f64; 3]],
    face: &[[i32; 3]],
    aamm: &[f64; 6],
    max_depth: i32,
    hierarchy: &Bvh,
) -> Octree {
    let centre: [f64; 3] = std::array::from_fn(|k| (aamm[k] + aamm[k + 3]) / 2.0);
    let half: [f64; 3] = std::array::from_fn(|k| (aamm[k + 3] - aamm[k]) / 2.0);
    let bounds = std::array::from_fn(|k| match k {
        0..3 => centre[k] - 1.1 * half[k],
        _ => centre[k - 3] + 1.1 * half[k - 3],
    });
    let triangles: Vec<_> = face.iter().map(|f| f.map(|v| vert[v as usize])).collect();
    let cells = Cells::around(&triangles, bounds, max_depth);
    let hanging = cells.hanging();
    let surface = Surface { triangles: &triangles, hierarchy };
    let distances = distances(&cells, &hanging, &surface);
    let list = &cells.list;
    Octree {
        depth: list.iter().map(|c| c.depth).collect(),
        child: list.iter().map(|c| c.child).collect(),
        aabb: list
            .iter()
            .map(|c| {
                let a = &c.aamm;
                std::array::from_fn(|k| match k {
                    0..3 => (a[k] + a[k + 3]) / 2.0,
                    _ => (a[k] - a[k - 3]) / 2.0,
                })
            })
            .collect(),
        coeff: list.iter().map(|c| c.corner.map(|v| distances[v])).collect(),
    }
}

/// Distances at all corners, from the largest cells on.
fn distances(cells: &Cells, hanging: &[Vec<usize>], surface: &Surface<'_>) -> Vec<f64> {
    let mut out = vec![0.0; cells.corners.len()];
    let mut done = vec![false; out.len()];
    let mut pending = VecDeque::from([0]);
    while let Some(cell) = pending.pop_front() {
        for &corner in &cells.list[cell].corner {
            if std::mem::replace(&mut done[corner], true) {
                continue;
            }
            let between = &hanging[corner];
            out[corner] = match between.len() {
                0 => surface.distance(cells.corners[corner]),
                n => between.iter().fold(0.0, |sum, &other| sum + out[other]) / n as f64,
            };
        }
        pending.extend(cells.list[cell].child.iter().filter_map(|&child| usize::try_from(child).ok()));
    }
    out
}
