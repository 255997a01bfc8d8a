//! Centres of mass, and inertias and motion axes about them: the frame of all com-based quantities
//! (Featherstone 2008, section 2; MuJoCo documentation, Computation, "Forward dynamics").

use crate::math::{Vec3, add, column, cross, inertia_about, scale, spatial, sub};
use crate::model::{JointType, Model, bounds::MINVAL};
use crate::sleep::{Awake, over};
use crate::stages::{Com, Kinematics};

/// Computes `subtree_com`, `cinert` and `cdof`.
pub fn com_pos(m: &Model, kin: &Kinematics, com: &mut Com) {
    com_pos_of(m, Awake::EVERYTHING, kin, com);
}

/// [`com_pos`] of what is awake.
pub(crate) fn com_pos_of(m: &Model, awake: Awake, kin: &Kinematics, com: &mut Com) {
    if awake.is_everything() {
        subtree_com(m, kin, &mut com.subtree_com);
    } else {
        subtree_com_of(m, awake, kin, &mut com.subtree_com);
    }
    com.cinert[0] = [0.0; 10];
    over!(awake.bodies(m), |bodies| about_centres(m, kin, com, bodies.skip(1)));
}

/// Inertias and motion axes of bodies, about the centres of mass of their trees.
#[inline(always)]
fn about_centres(m: &Model, kin: &Kinematics, com: &mut Com, bodies: impl Iterator<Item = usize>) {
    for b in bodies {
        let reference = com.subtree_com[m.body_rootid[b] as usize];
        let offset = sub(kin.xipos[b], reference);
        com.cinert[b] = inertia_about(m.body_inertia[b], &kin.ximat[b], offset, m.body_mass[b]);
        for j in m.body_jntadr[b]..m.body_jntadr[b] + m.body_jntnum[b] {
            motion_axes(m, kin, b, j as usize, reference, com);
        }
    }
}

/// Centre of mass of every subtree; the body's own where the subtree has no mass.
fn subtree_com(m: &Model, kin: &Kinematics, subtree: &mut [Vec3]) {
    for b in 0..m.nbody {
        subtree[b] = scale(kin.xipos[b], m.body_mass[b]);
    }
    for b in (1..m.nbody).rev() {
        let parent = m.body_parentid[b] as usize;
        subtree[parent] = add(subtree[parent], subtree[b]);
    }
    for b in 0..m.nbody {
        let mass = m.body_subtreemass[b];
        subtree[b] = if mass < MINVAL { kin.xipos[b] } else { scale(subtree[b], 1.0 / mass) };
    }
}

/// The same where trees sleep, whose centres are known.
fn subtree_com_of(m: &Model, awake: Awake, kin: &Kinematics, subtree: &mut [Vec3]) {
    over!(awake.bodies(m), |bodies| bodies.for_each(|b| subtree[b] = scale(kin.xipos[b], m.body_mass[b])));
    over!(awake.children(m), |bodies| for b in bodies.rev() {
        let parent = m.body_parentid[b] as usize;
        let moment = if awake.sleeps(b) { scale(subtree[b], m.body_subtreemass[b]) } else { subtree[b] };
        subtree[parent] = add(subtree[parent], moment);
    });
    over!(awake.bodies(m), |bodies| for b in bodies {
        let mass = m.body_subtreemass[b];
        subtree[b] = if mass < MINVAL { kin.xipos[b] } else { scale(subtree[b], 1.0 / mass) };
    });
}

/// Columns that joint `j` of body `b` contributes to `cdof`.
#[inline(always)]
fn motion_axes(m: &Model, kin: &Kinematics, b: usize, j: usize, reference: Vec3, com: &mut Com) {
    let dof = m.jnt_dofadr[j] as usize;
    let arm = sub(reference, kin.xanchor[j]);
    let turning = |axis: Vec3| spatial(axis, cross(axis, arm));
    match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Free) => {
            for k in 0..3 {
                com.cdof[dof + k] = [0.0; 6];
                com.cdof[dof + k][3 + k] = 1.0;
                com.cdof[dof + 3 + k] = turning(column(&kin.xmat[b], k));
            }
        }
        Some(JointType::Ball) => {
            for k in 0..3 {
                com.cdof[dof + k] = turning(column(&kin.xmat[b], k));
            }
        }
        Some(JointType::Slide) => com.cdof[dof] = spatial([0.0; 3], kin.xaxis[j]),
        Some(JointType::Hinge) | None => com.cdof[dof] = turning(kin.xaxis[j]),
    }
}
