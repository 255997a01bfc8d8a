//! Velocities of bodies and of motion axes (Featherstone 2008, section 5.3, first pass), momenta of subtrees.

use crate::data::{Com, Kinematics, Sensors, State, Velocity};
use crate::frame::Frame;
use crate::math::{
    Spatial, Vec3, add, cross, cross_motion, linear, mul_mat_t_vec, mul_mat_vec, rotational, scale,
    spatial_add_scaled, sub,
};
use crate::model::{JointType, Model, bounds::MINVAL};
use std::ops::Range;

/// Computes `cvel` and `cdof_dot`.
pub fn com_vel(m: &Model, state: &State, com: &Com, vel: &mut Velocity) {
    vel.cvel[0] = [0.0; 6];
    for b in 1..m.nbody {
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

/// Computes linear velocity and angular momentum of every subtree about its centre of mass.
pub fn subtree_velocity(m: &Model, kin: &Kinematics, com: &Com, vel: &Velocity, out: &mut Sensors) {
    let (linvel, angmom) = (&mut out.subtree_linvel, &mut out.subtree_angmom);
    let body = |b: usize| -> Spatial {
        Frame { body: b, pos: kin.xipos[b], mat: kin.ximat[b] }.velocity(m, com, &vel.cvel)
    };
    for b in 0..m.nbody {
        let v = body(b);
        linvel[b] = scale(linear(&v), m.body_mass[b]);
        let spin = mul_mat_t_vec(&kin.ximat[b], rotational(&v));
        let moments = m.body_inertia[b];
        let own = [spin[0] * moments[0], spin[1] * moments[1], spin[2] * moments[2]];
        angmom[b] = mul_mat_vec(&kin.ximat[b], own);
    }
    for b in (0..m.nbody).rev() {
        if b > 0 {
            let momentum = linvel[b];
            accumulate(linvel, m.body_parentid[b] as usize, momentum);
        }
        linvel[b] = scale(linvel[b], 1.0 / m.body_subtreemass[b].max(MINVAL));
    }
    for b in (1..m.nbody).rev() {
        let parent = m.body_parentid[b] as usize;
        let momentum = scale(sub(linear(&body(b)), linvel[b]), m.body_mass[b]);
        accumulate(angmom, b, cross(sub(kin.xipos[b], com.subtree_com[b]), momentum));
        let spin = angmom[b];
        accumulate(angmom, parent, spin);
        let relative = scale(sub(linvel[b], linvel[parent]), m.body_subtreemass[b]);
        accumulate(angmom, parent, cross(sub(com.subtree_com[b], com.subtree_com[parent]), relative));
    }
}

fn accumulate(sums: &mut [Vec3], at: usize, part: Vec3) {
    sums[at] = add(sums[at], part);
}
