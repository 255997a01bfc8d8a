//! Elasticity of interpolated flexes: every cell of the lattice has a constant stiffness matrix in a frame that turns
//! with the cell (corotational finite elements; Müller and Gross, Interactive Virtual Materials, 2004).

use super::lattice::{Lattice, MAX_NODES, track_interior};
use super::scratch::FlexScratch;
use super::stretch::Inputs;
use super::vertices;
use crate::math::dense::dot_slice;
use crate::math::{Vec3, add, cross, linear, mul_mat_t_vec, quat_conj, quat_rotate, rotational, scale, sub};
use crate::model::flex::{Flex, held};
use crate::position::chain::{apply_wrench, com_offset};
use crate::stages::Passive;

/// Adds the elastic forces of the cells of an interpolated flex, and the forces of damping proportional to stiffness.
pub(crate) fn cells(
    flex: Flex,
    at: Inputs,
    [springs, dampers]: [bool; 2],
    scratch: &mut FlexScratch,
    out: &mut Passive,
) {
    let m = flex.m;
    let Some(first) = flex.stiffness().filter(|_| m.flex_edgeequality[flex.id] != held::STRAINS) else {
        return;
    };
    let lattice = Lattice::new(flex);
    let FlexScratch { nodes, speeds, force, drag, .. } = scratch;
    vertices::nodes(flex, at.kin, nodes);
    node_velocities(flex, &lattice, at, nodes, speeds);
    for sum in [&mut *force, &mut *drag] {
        sum.clear();
        sum.resize(nodes.len(), [0.0; 3]);
    }
    for cell in 0..lattice.patches() {
        let patch = lattice.patch(cell);
        let size = 3 * patch.nodes().len();
        let stiffness = &m.flex_stiffness[first + cell * size * size..first + (cell + 1) * size * size];
        if stiffness[0] == 0.0 {
            continue;
        }
        let mut points = [[0.0; 3]; MAX_NODES];
        for (point, &n) in points.iter_mut().zip(patch.nodes()) {
            *point = nodes[n];
        }
        let back = patch.inverse_rotation(&points[..patch.nodes().len()]);
        let product = |vectors: &[Vec3; MAX_NODES], sums: &mut [Vec3]| {
            for (k, &n) in patch.nodes().iter().enumerate() {
                let rows = &stiffness[3 * k * size..];
                let vectors = &vectors.as_flattened()[..size];
                let local = [0, 1, 2].map(|x| dot_slice(&rows[x * size..(x + 1) * size], vectors));
                sums[n] = add(sums[n], quat_rotate(quat_conj(back), local));
            }
        };
        if springs {
            for (point, &n) in points.iter_mut().zip(patch.nodes()) {
                *point = sub(quat_rotate(back, *point), m.flex_node0[flex.nodes().start + n]);
            }
            product(&points, force);
        }
        if dampers {
            for (point, &n) in points.iter_mut().zip(patch.nodes()) {
                *point = quat_rotate(back, speeds[n]);
            }
            product(&points, drag);
        }
    }
    if springs {
        apply(flex, at, nodes, force, &mut out.qfrc_spring);
    }
    if dampers {
        drag.iter_mut().for_each(|f| *f = scale(*f, m.flex_damping[flex.id]));
        apply(flex, at, nodes, drag, &mut out.qfrc_damper);
    }
}

/// Velocities of the nodes; those inside a shell follow from its faces.
fn node_velocities(flex: Flex, lattice: &Lattice, at: Inputs, points: &[Vec3], out: &mut Vec<Vec3>) {
    let m = flex.m;
    out.clear();
    out.extend(flex.node_bodies().iter().zip(points).map(|(&body, &point)| {
        let b = body as usize;
        if m.body_dofnum[m.body_weldid[b] as usize] == 0 {
            return [0.0; 3];
        }
        let (motion, centre) = (&at.vel.cvel[b], at.kin.xipos[b]);
        let spin = rotational(motion);
        let of_centre = sub(linear(motion), cross(com_offset(m, at.com, b, centre), spin));
        add(of_centre, cross(spin, sub(point, centre)))
    }));
    if lattice.is_shell {
        track_interior(lattice.size, out);
    }
}

/// Adds forces at nodes to `qfrc`, directly where a node is at the origin of a body that moves.
pub(super) fn apply(flex: Flex, at: Inputs, points: &[Vec3], force: &[Vec3], qfrc: &mut [f64]) {
    let m = flex.m;
    let centred = |n: usize| m.flex_centered[flex.id] || m.flex_node[n] == [0.0; 3];
    for ((n, &point), &force) in flex.nodes().zip(points).zip(force) {
        let body = m.flex_nodebodyid[n] as usize;
        if m.body_dofnum[body] > 0 && centred(n) {
            let local = mul_mat_t_vec(&at.kin.xmat[body], force);
            let first = m.body_dofadr[body] as usize;
            (0..3).for_each(|x| qfrc[first + x] += local[x]);
        } else {
            apply_wrench(m, at.com, body, point, force, [0.0; 3], qfrc);
        }
    }
}
