//! Stiffness that is applied term by term: of stretched elements, and of cells that turn with their lattice.

use super::matrix::tension;
use super::stiffened::{Rates, cell_stiffness, is_elastic_lattice};
use crate::flex::lattice::{Lattice, MAX_NODES, Patch};
use crate::flex::stretch::{METRIC, TETRAHEDRON, TRIANGLE, unpack};
use crate::flex::vertices::placed;
use crate::math::{Mat3, Vec3, add_scaled, mul_mat, mul_mat_t_vec, mul_mat_vec, quat_to_mat, sub, transpose};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::position::chain::{apply_wrench, chain, com_offset, point_column};
use crate::stages::{Flexes, Kinematics, Poses};

/// First degree of freedom of a body with three.
fn free_dof(m: &Model, body: usize) -> Option<usize> {
    usize::try_from(m.body_dofadr[body]).ok().filter(|_| m.body_dofnum[body] == 3)
}

/// What a vector of all degrees of freedom has for a body, in the world.
fn of_body(m: &Model, kin: &Kinematics, body: usize, v: &[f64]) -> Option<Vec3> {
    free_dof(m, body).map(|dof| mul_mat_vec(&kin.xmat[body], [v[dof], v[dof + 1], v[dof + 2]]))
}

/// Adds a vector in the world to the degrees of freedom of a body.
fn add_to_body(m: &Model, kin: &Kinematics, body: usize, force: Vec3, scale: f64, out: &mut [f64]) {
    if let Some(dof) = free_dof(m, body) {
        let local = mul_mat_t_vec(&kin.xmat[body], force);
        (0..3).for_each(|x| out[dof + x] += scale * local[x]);
    }
}

/// Adds the stiffness of stretched elements times `v`.
pub(super) fn add_stretch(
    m: &Model,
    kin: &Kinematics,
    flexes: &Flexes,
    rates: Rates,
    v: &[f64],
    out: &mut [f64],
) {
    for flex in Flex::all(m).filter(|flex| flex.has_edges()) {
        let scale = rates.of(flex);
        if scale != 0.0 {
            match flex.dim() {
                2 => add_elements(flex, &TRIANGLE, scale, (kin, flexes), v, out),
                3 => add_elements(flex, &TETRAHEDRON, scale, (kin, flexes), v, out),
                _ => {}
            }
        }
    }
}

fn add_elements<const E: usize>(
    flex: Flex,
    ends: &[[usize; 2]; E],
    scale: f64,
    (kin, flexes): (&Kinematics, &Flexes),
    v: &[f64],
    out: &mut [f64],
) {
    let m = flex.m;
    let Some(first) = flex.stiffness() else { return };
    let (points, bodies) = (&flexes.flexvert_xpos[flex.vertices()], flex.vertex_bodies());
    let edges = &m.flex_elemedge[m.flex_elemedgeadr[flex.id].max(0) as usize..];
    let corners = flex.corners().chunks_exact(flex.dim() + 1);
    let metrics = m.flex_stiffness[first..].chunks_exact(METRIC);
    for ((corners, edges), packed) in corners.zip(edges.chunks_exact(E)).zip(metrics) {
        let metric: [[f64; E]; E] = unpack(packed);
        let tension = tension(flex, flexes, edges, &metric);
        let body = |k: usize| bodies[corners[k] as usize] as usize;
        let point = |k: usize| points[corners[k] as usize];
        let moved = |k: usize| of_body(m, kin, body(k), v).unwrap_or_default();
        let span = ends.map(|[a, b]| sub(point(a), point(b)));
        let change = ends.map(|[a, b]| sub(moved(a), moved(b)));
        let stretch: [f64; E] =
            std::array::from_fn(|e| (0..3).fold(0.0, |sum, x| sum + span[e][x] * change[e][x]));
        for (e, &[a, b]) in ends.iter().enumerate() {
            let along = metric[e].iter().zip(&stretch).fold(0.0, |sum, (share, s)| sum + share * s);
            let along = along * (2.0 * scale);
            let force = [0, 1, 2].map(|x| along * span[e][x] + scale * tension[e] * change[e][x]);
            add_to_body(m, kin, body(a), force, 1.0, out);
            add_to_body(m, kin, body(b), force, -1.0, out);
        }
    }
}

/// Computes the stiffness of the cells of a lattice with nodes at `points` in the axes of the world.
pub(super) fn turn_cells(flex: Flex, points: &[Vec3], out: &mut [f64]) {
    let Some(first) = flex.stiffness() else { return };
    for_cells(flex, first, |patch, at| {
        let mut own = [[0.0; 3]; MAX_NODES];
        for (own, &n) in own.iter_mut().zip(patch.nodes()) {
            *own = points[n];
        }
        let count = patch.nodes().len();
        let back = quat_to_mat(patch.inverse_rotation(&own[..count]));
        let (ahead, size) = (transpose(&back), 3 * count);
        let (stiffness, turned) = (&flex.m.flex_stiffness[at.clone()], &mut out[at]);
        for i in 0..count {
            for j in 0..count {
                let place = |k: usize| (3 * i + k / 3) * size + 3 * j + k % 3;
                let block: Mat3 = std::array::from_fn(|k| stiffness[place(k)]);
                let block = mul_mat(&ahead, &mul_mat(&block, &back));
                (0..9).for_each(|k| turned[place(k)] = block[k]);
            }
        }
    });
}

/// Calls `f` with each cell that has stiffness and where that is.
fn for_cells(flex: Flex, first: usize, mut f: impl FnMut(&Patch, std::ops::Range<usize>)) {
    let lattice = Lattice::new(flex);
    for cell in 0..lattice.patches() {
        let patch = lattice.patch(cell);
        let at = cell_stiffness(first, cell, 3 * patch.nodes().len());
        if flex.m.flex_stiffness[at.start] != 0.0 {
            f(&patch, at);
        }
    }
}

/// A node of a lattice, fixed to a body.
#[derive(Clone, Copy)]
struct Node<'a> {
    m: &'a Model,
    poses: Poses<'a>,
    body: usize,
    point: Vec3,
}

impl<'a> Node<'a> {
    fn of(flex: Flex<'a>, poses: Poses<'a>, n: usize) -> Self {
        let (m, at) = (flex.m, flex.nodes().start + n);
        let body = m.flex_nodebodyid[at] as usize;
        let point = placed(poses.kin, body, m.flex_node[at], m.flex_centered[flex.id]);
        Node { m, poses, body, point }
    }

    /// The body does nothing but slide along three axes.
    fn slides(self) -> bool {
        self.m.body_simple[self.body] == 2 && self.m.body_dofnum[self.body] == 3
    }

    /// Velocity of the node with velocities `v` of all degrees of freedom.
    fn velocity(self, v: &[f64]) -> Vec3 {
        let Node { m, poses, body, point } = self;
        if self.slides() {
            return of_body(m, poses.kin, body, v).unwrap_or_default();
        }
        let offset = com_offset(m, poses.com, body, point);
        chain(m, body)
            .fold([0.0; 3], |sum, dof| add_scaled(sum, point_column(poses.com, dof, offset), v[dof]))
    }

    fn push(self, force: Vec3, out: &mut [f64]) {
        let Node { m, poses, body, point } = self;
        if self.slides() {
            add_to_body(m, poses.kin, body, force, 1.0, out);
        } else {
            apply_wrench(m, poses.com, body, point, force, [0.0; 3], out);
        }
    }
}

/// Subtracts the stiffness of cells, as [`turn_cells`] has found it, times `v`.
pub(super) fn add_cells(m: &Model, poses: Poses, flexes: &Flexes, rates: Rates, v: &[f64], out: &mut [f64]) {
    for flex in Flex::all(m).filter(|flex| is_elastic_lattice(*flex)) {
        let rate = -rates.of(flex);
        let Some(first) = flex.stiffness().filter(|_| rate != 0.0) else { continue };
        for_cells(flex, first, |patch, at| {
            let stiffness = &flexes.flexelem_krot[at];
            let size = 3 * patch.nodes().len();
            let mut moved = [[0.0; 3]; MAX_NODES];
            for (moved, &n) in moved.iter_mut().zip(patch.nodes()) {
                *moved = Node::of(flex, poses, n).velocity(v);
            }
            let moved = &moved.as_flattened()[..size];
            for (i, &n) in patch.nodes().iter().enumerate() {
                let force = [0, 1, 2].map(|r| {
                    let row = &stiffness[(3 * i + r) * size..(3 * i + r + 1) * size];
                    row.iter().zip(moved).fold(0.0, |sum, (k, x)| sum + rate * k * x)
                });
                Node::of(flex, poses, n).push(force, out);
            }
        });
    }
}
