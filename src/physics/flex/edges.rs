//! Lengths of edges, their Jacobian and their velocities.

use crate::math::{Vec3, dot, dot_sparse, linear, normalize, scale, sub};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::position::chain::{MergedChain, com_offset, point_column};
use crate::stages::{Com, Flexes, State};
use std::ops::Range;

/// Entries of edge `e` in the Jacobian of edge lengths.
pub(crate) fn row(m: &Model, e: usize) -> Range<usize> {
    let start = m.flexedge_J_rowadr[e] as usize;
    start..start + m.flexedge_J_rownnz[e] as usize
}

/// Computes `flexedge_length` and, where a force or constraint needs it, `flexedge_J`.
pub(super) fn edges(m: &Model, com: &Com, out: &mut Flexes) {
    out.flexedge_J.fill(0.0);
    out.flexedge_length.fill(0.0);
    Flex::all(m).filter(|flex| flex.has_edges()).for_each(|flex| measure(flex, com, out));
}

/// Lengths and, where they are needed, Jacobians of the edges of a flex.
fn measure(flex: Flex, com: &Com, out: &mut Flexes) {
    let m = flex.m;
    let (first, needed) = (flex.vertices().start, flex.needs_edge_jacobian());
    for e in flex.edges() {
        let ends = m.flex_edge[e].map(|v| first + v as usize);
        let points = ends.map(|v| out.flexvert_xpos[v]);
        let (direction, length) = normalize(sub(points[1], points[0]));
        out.flexedge_length[e] = length;
        if needed {
            let bodies = ends.map(|v| m.flex_vertbodyid[v] as usize);
            let entries = &mut out.flexedge_J[row(m, e)];
            if let (Some(dofs), Some(entries)) = (sliding_dofs(m, bodies), entries.as_mut_array::<6>()) {
                *entries = sliding_row(com, dofs, direction);
                continue;
            }
            let changes = length_row(m, com, bodies, points, direction);
            for (entry, (_, change)) in entries.iter_mut().rev().zip(changes) {
                *entry = change;
            }
        }
    }
}

/// First degrees of freedom of two bodies that do nothing but slide along three axes each.
fn sliding_dofs(m: &Model, bodies: [usize; 2]) -> Option<[usize; 2]> {
    let slide = bodies.iter().all(|&body| m.body_simple[body] == 2 && m.body_dofnum[body] == 3);
    (slide && bodies[0] != bodies[1]).then(|| bodies.map(|body| m.body_dofadr[body] as usize))
}

/// [`length_row`] of such bodies, from the first degree of freedom on.
fn sliding_row(com: &Com, [a, b]: [usize; 2], direction: Vec3) -> [f64; 6] {
    let along = |first: usize, sign: f64| {
        [0, 1, 2].map(|k| dot(direction, scale(linear(&com.cdof[first + k]), sign)))
    };
    let ([x, y, z], [u, v, w]) = (along(a, -1.0), along(b, 1.0));
    if a < b { [x, y, z, u, v, w] } else { [u, v, w, x, y, z] }
}

/// How the distance of two points of two bodies, the second in `direction` of the first, changes with each degree of
/// freedom that moves either, from the last one on.
#[inline]
pub(crate) fn length_row<'a>(
    m: &'a Model,
    com: &'a Com,
    [a, b]: [usize; 2],
    points: [Vec3; 2],
    direction: Vec3,
) -> impl Iterator<Item = (usize, f64)> + use<'a> {
    let (from_a, from_b) = (com_offset(m, com, a, points[0]), com_offset(m, com, b, points[1]));
    MergedChain::new(m, a, b).map(move |(dof, moves)| {
        let column = match moves {
            [true, true] => sub(point_column(com, dof, from_b), point_column(com, dof, from_a)),
            [true, false] => scale(point_column(com, dof, from_a), -1.0),
            [false, _] => point_column(com, dof, from_b),
        };
        (dof, dot(direction, column))
    })
}

/// Computes `flexedge_velocity`.
pub fn edge_velocities(m: &Model, state: &State, flex: &Flexes, out: &mut [f64]) {
    out.fill(0.0);
    for part in Flex::all(m).filter(|flex| flex.has_edges()) {
        for e in part.edges() {
            let at = row(m, e);
            out[e] = dot_sparse(&flex.flexedge_J[at.clone()], &m.flexedge_J_colind[at], &state.qvel);
        }
    }
}
