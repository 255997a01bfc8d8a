//! Velocities of bodies and of motion axes (Featherstone 2008, section 5.3, first pass).

use crate::math::{Spatial, cross_motion, spatial_add_scaled};
use crate::model::{JointType, Model};
use crate::sleep::{Awake, over};
use crate::stages::{Com, State, Velocity};
use std::ops::Range;

/// Computes `cvel` and `cdof_dot`.
pub fn com_vel(m: &Model, state: &State, com: &Com, vel: &mut Velocity) {
    vel.cvel[0] = [0.0; 6];
    over!(Awake::of(m, state).bodies(m), |bodies| velocities(m, state, com, vel, bodies.skip(1)));
}

/// Velocities of bodies, parents before children.
#[inline]
fn velocities(m: &Model, state: &State, com: &Com, vel: &mut Velocity, bodies: impl Iterator<Item = usize>) {
    for b in bodies {
        let mut v = vel.cvel[m.body_parentid[b] as usize];
        for j in m.body_jntadr[b]..m.body_jntadr[b] + m.body_jntnum[b] {
            let dof = m.jnt_dofadr[j as usize] as usize;
            match JointType::from_code(m.jnt_type[j as usize]) {
                Some(JointType::Free) => {
                    // Translations are along the world axes.
                    vel.cdof_dot[dof..dof + 3].fill([0.0; 6]);
                    add_motion(&com.cdof, &state.qvel, dof..dof + 3, &mut v);
                    turn(com, state, dof + 3..dof + 6, &mut v, vel);
                }
                Some(JointType::Ball) => turn(com, state, dof..dof + 3, &mut v, vel),
                Some(JointType::Slide | JointType::Hinge) | None => {
                    turn(com, state, dof..dof + 1, &mut v, vel);
                }
            }
        }
        vel.cvel[b] = v;
    }
}

/// Rates of axes that move with the velocity `v` before this joint, then the joint's own velocity.
fn turn(com: &Com, state: &State, dofs: Range<usize>, v: &mut Spatial, vel: &mut Velocity) {
    for dof in dofs.clone() {
        vel.cdof_dot[dof] = cross_motion(v, &com.cdof[dof]);
    }
    add_motion(&com.cdof, &state.qvel, dofs, v);
}

/// `v += sum over dofs of axes * rates`.
pub fn add_motion(axes: &[Spatial], rates: &[f64], dofs: Range<usize>, v: &mut Spatial) {
    let mut sum = [0.0; 6];
    for (axis, &rate) in axes[dofs.clone()].iter().zip(&rates[dofs]) {
        spatial_add_scaled(&mut sum, axis, rate);
    }
    for i in 0..6 {
        v[i] += sum[i];
    }
}

/// Degrees of freedom of body `b`.
pub fn dofs(m: &Model, b: usize) -> Range<usize> {
    let count = m.body_dofnum[b] as usize;
    let start = usize::try_from(m.body_dofadr[b]).unwrap_or(0);
    start..start + count
}
