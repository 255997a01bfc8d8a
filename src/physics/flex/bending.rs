//! Bending of sheets: a quadratic energy of the two triangles at each edge (Wardetzky et al., Discrete quadratic
//! curvature energies, 2007), with a cubic term where the sheet is curved at rest (Garg et al., Cubic shells, 2007).

use crate::math::{Vec3, cross, mul_mat_t_vec, sub};
use crate::model::flex::Flex;
use crate::stages::{Flexes, Kinematics, Passive};

/// Numbers of an edge in `flex_bending`: a 4x4 matrix, and the weight of the rest curvature.
pub(crate) const STENCIL: usize = 17;

/// Dofs of the vertices that bending acts on: those that are free in all three directions.
fn free_dof(flex: Flex, body: usize) -> Option<usize> {
    let m = flex.m;
    (m.body_dofnum[body] == 3).then(|| m.body_dofadr[body].max(0) as usize)
}

/// Adds the forces of the bent edges of a sheet.
pub(crate) fn bending(
    flex: Flex,
    kin: &Kinematics,
    flexes: &Flexes,
    qvel: &[f64],
    [springs, dampers]: [bool; 2],
    out: &mut Passive,
) {
    let m = flex.m;
    let Some(first) = flex.bending().filter(|_| flex.dim() == 2) else { return };
    let (points, bodies) = (&flexes.flexvert_xpos[flex.vertices()], flex.vertex_bodies());
    let damping = m.flex_damping[flex.id];
    let stencils = m.flex_bending[first..].chunks_exact(STENCIL);
    for (e, stencil) in flex.edges().zip(stencils) {
        let ([a, b], [c, d]) = (m.flex_edge[e], m.flex_edgeflap[e]);
        if d == -1 {
            continue;
        }
        let corners = [a, b, c, d].map(|v| v as usize);
        let bodies = corners.map(|v| bodies[v] as usize);
        let dofs = bodies.map(|body| free_dof(flex, body));
        let push = |i: usize, force: Vec3, share: f64, qfrc: &mut [f64]| {
            let Some(dof) = dofs[i] else { return };
            let local = mul_mat_t_vec(&kin.xmat[bodies[i]], force);
            (0..3).for_each(|x| qfrc[dof + x] -= local[x] * share);
        };
        if springs {
            let corners = corners.map(|v| points[v]);
            let curved = rest_pull(&corners);
            for (i, curved) in curved.into_iter().enumerate() {
                let mut force = row_times(stencil, i, &corners);
                (0..3).for_each(|x| force[x] += stencil[16] * curved[x]);
                push(i, force, 1.0, &mut out.qfrc_spring);
            }
        }
        if dampers && damping != 0.0 {
            let speeds = dofs.map(|dof| dof.map_or([0.0; 3], |d| [qvel[d], qvel[d + 1], qvel[d + 2]]));
            for i in 0..4 {
                push(i, row_times(stencil, i, &speeds), damping, &mut out.qfrc_damper);
            }
        }
    }
}

/// Row `i` of the stencil times four vectors.
fn row_times(stencil: &[f64], i: usize, vectors: &[Vec3; 4]) -> Vec3 {
    let mut sum = [0.0; 3];
    for (&share, vector) in stencil[4 * i..4 * i + 4].iter().zip(vectors) {
        (0..3).for_each(|x| sum[x] += share * vector[x]);
    }
    sum
}

/// Directions in which a curved rest shape pulls the four vertices.
fn rest_pull(corners: &[Vec3; 4]) -> [Vec3; 4] {
    let [along, left, right] = [1, 2, 3].map(|k| sub(corners[k], corners[0]));
    let [b, c, d] = [cross(left, right), cross(right, along), cross(along, left)];
    let a = [0, 1, 2].map(|x| -(b[x] + c[x] + d[x]));
    [a, b, c, d]
}
