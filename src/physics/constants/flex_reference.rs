//! What follows from flexes at `qpos0`: metrics of vertices, lengths and inverse weights of edges.

use super::flex_pattern::{self, ends, has_springs, holds_vertices};
use crate::data::{Com, Kinematics};
use crate::flex::{edges, vertices::placed};
use crate::math::{Vec3, cross, mul_mat_t_vec, normalize, quat_from_z, quat_to_mat, sub};
use crate::model::bounds::MINVAL;
use crate::model::{Arrays, Model, ObjType};

/// Sets the metrics of the vertices that constraints hold, and turns the reference vertices of such flexes so that they lie
/// in the plane of x and y.
///
/// # Errors
/// The flex whose vertices are not in such a plane at the start.
pub(super) fn set_metrics(m: &mut Model) -> Result<(), String> {
    if m.nflex == 0 {
        return Ok(());
    }
    let mut metric = vec![[0.0; 4]; m.nflexvert];
    for f in (0..m.nflex).filter(|&f| holds_vertices(m, f)) {
        let mut shape = vec![[0.0; 4]; m.nflexvert];
        for e in flex_pattern::edges(m, f) {
            let ends = ends(m, f, e);
            let rest = rest(m, f, ends);
            if rest[2].abs() > MINVAL {
                return Err(m.label_of(ObjType::Flex, f));
            }
            for (v, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
                let weight = weight(m, other);
                for (k, sum) in shape[v].iter_mut().enumerate() {
                    *sum += weight * rest[k / 2] * rest[k % 2];
                }
            }
        }
        let first = m.flex_vertadr[f] as usize;
        for v in first..first + m.flex_vertnum[f] as usize {
            metric[v] = inverse(shape[v]);
        }
    }
    let turned = aligned(m);
    let arrays = m.derived_mut();
    arrays.flex_vertmetric.update(&metric);
    arrays.flex_vert0.update(&turned);
    Ok(())
}

/// An edge at rest.
fn rest(m: &Arrays, f: usize, [a, b]: [usize; 2]) -> Vec3 {
    let edge = sub(m.flex_vert0[b], m.flex_vert0[a]);
    std::array::from_fn(|k| edge[k] * (2.0 * m.flex_size[f][k]))
}

/// Mass of a vertex.
fn weight(m: &Arrays, v: usize) -> f64 {
    let mass = m.body_mass[m.flex_vertbodyid[v] as usize];
    if mass < MINVAL { MINVAL } else { mass }
}

fn inverse([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    let determinant = a * d - b * c;
    if determinant.abs() < MINVAL {
        return [0.0; 4];
    }
    let inverse = 1.0 / determinant;
    [d * inverse, -b * inverse, -c * inverse, a * inverse]
}

/// Reference vertices. Constrained surfaces are turned by the rotation that takes the normal of their first element to z.
fn aligned(m: &Arrays) -> Vec<Vec3> {
    let mut vert0 = m.flex_vert0.to_vec();
    for f in (0..m.nflex).filter(|&f| m.flex_dim[f] == 2 && m.flex_edgeequality[f] == 2) {
        let first = m.flex_vertadr[f] as usize;
        let corners = &m.flex_elem[m.flex_elemdataadr[f] as usize..][..3];
        let [a, b, c] = [0, 1, 2].map(|k| vert0[first + corners[k] as usize]);
        let (normal, _) = normalize(cross(sub(b, a), sub(c, a)));
        let turn = quat_to_mat(quat_from_z(normal));
        for point in &mut vert0[first..first + m.flex_vertnum[f] as usize] {
            *point = mul_mat_t_vec(&turn, *point);
        }
    }
    vert0
}

/// Where a vertex that is fixed to a body is.
fn position(m: &Arrays, kin: &Kinematics, v: usize) -> Vec3 {
    placed(kin, m.flex_vertbodyid[v] as usize, m.flex_vert[v], false)
}

/// Edges of flexes whose vertices are fixed to bodies, with their flex; rigid flexes included.
pub(super) fn measured(m: &Arrays) -> impl Iterator<Item = (usize, usize)> {
    (0..m.nflex)
        .filter(|&f| m.flex_interp[f] == 0)
        .flat_map(|f| flex_pattern::edges(m, f).map(move |e| (f, e)))
}

/// Lengths of all edges; 0 for edges of interpolated flexes.
pub(super) fn lengths(m: &Arrays, kin: &Kinematics) -> Vec<f64> {
    let mut lengths = vec![0.0; m.nflexedge];
    for (f, e) in measured(m) {
        let [a, b] = ends(m, f, e).map(|v| position(m, kin, v));
        lengths[e] = normalize(sub(b, a)).1;
    }
    lengths
}

/// How the length of edge `e` of flex `f` changes with each degree of freedom; nothing where no force or constraint acts
/// along edges.
pub(super) fn length_row(m: &Model, kin: &Kinematics, com: &Com, f: usize, e: usize) -> Vec<(usize, f64)> {
    if m.flex_edgeequality[f] != 1 && !has_springs(m, f) {
        return Vec::new();
    }
    let ends = ends(m, f, e);
    let points = ends.map(|v| position(m, kin, v));
    let bodies = ends.map(|v| m.flex_vertbodyid[v] as usize);
    let (direction, _) = normalize(sub(points[1], points[0]));
    edges::length_row(m, com, bodies, points, direction).collect()
}
