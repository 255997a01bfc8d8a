//! Chains of degrees of freedom from a body up to the root of its tree, and the columns of point Jacobians along
//! them. A chain is walked from the last degree of freedom to the first, so indices decrease.

use crate::math::{Vec3, add, cross, dot, linear, rotational, sub};
use crate::model::{Arrays, Model};
use crate::stages::{Com, Kinematics};

/// Last degree of freedom that moves body `b`; -1 for a static body.
pub fn last_dof(m: &Arrays, b: usize) -> i32 {
    let mover = m.body_weldid[b] as usize;
    (m.body_dofadr[mover] + m.body_dofnum[mover] - 1).max(-1)
}

/// The chains of two bodies merged; the flags tell which of them a degree of freedom moves.
pub struct MergedChain<'a> {
    parent: &'a [i32],
    next: [i32; 2],
}

impl<'a> MergedChain<'a> {
    /// Walks the degrees of freedom that move `first` or `second`.
    pub fn new(m: &'a Model, first: usize, second: usize) -> Self {
        MergedChain { parent: &m.dof_parentid, next: [last_dof(m, first), last_dof(m, second)] }
    }
}

impl Iterator for MergedChain<'_> {
    type Item = (usize, [bool; 2]);

    fn next(&mut self) -> Option<Self::Item> {
        let dof = usize::try_from(self.next[0].max(self.next[1])).ok()?;
        let moves = self.next.map(|n| n == dof as i32);
        for (n, moved) in self.next.iter_mut().zip(moves) {
            if moved {
                *n = self.parent[dof];
            }
        }
        Some((dof, moves))
    }
}

/// Walks the degrees of freedom that move body `b`.
pub fn chain(m: &Model, b: usize) -> impl Iterator<Item = usize> {
    let parent = &m.dof_parentid;
    std::iter::successors(usize::try_from(last_dof(m, b)).ok(), move |&dof| usize::try_from(parent[dof]).ok())
}

/// Offset of `point` from the reference point of the com-based quantities of body `b`.
pub fn com_offset(m: &Model, com: &Com, b: usize, point: Vec3) -> Vec3 {
    sub(point, com.subtree_com[m.body_rootid[b] as usize])
}

/// Velocity, per unit of degree of freedom `dof`, of a point at `offset` from the reference point.
pub fn point_column(com: &Com, dof: usize, offset: Vec3) -> Vec3 {
    let axis = &com.cdof[dof];
    add(linear(axis), cross(rotational(axis), offset))
}

/// Adds to `qfrc` what `force` and `torque`, applied to body `b` at `point`, make in joint space.
pub fn apply_wrench(
    m: &Model,
    com: &Com,
    b: usize,
    point: Vec3,
    force: Vec3,
    torque: Vec3,
    qfrc: &mut [f64],
) {
    let offset = com_offset(m, com, b, point);
    for dof in chain(m, b) {
        qfrc[dof] += dot(point_column(com, dof, offset), force);
        qfrc[dof] += dot(rotational(&com.cdof[dof]), torque);
    }
}

/// Body of `site` and its position.
pub fn site_point(m: &Model, kin: &Kinematics, site: usize) -> (usize, Vec3) {
    (m.site_bodyid[site] as usize, kin.site_xpos[site])
}
