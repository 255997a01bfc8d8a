//! What all integrators share: joint damping at the end of the step, histories and activations, and motion with
//! quaternions on the sphere (MuJoCo documentation, Computation, "Numerical integration").
//!
//! ```
//! use robohive_physics::integration::integrate::{differentiate_pos, integrate_pos};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut qpos = model.qpos0.clone();
//! integrate_pos(&model, &mut qpos, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.4], 0.5);
//! assert_eq!(qpos[2], 2.5);
//! let mut qvel = [0.0; 6];
//! differentiate_pos(&model, &model.qpos0, &qpos, 0.5, &mut qvel);
//! assert!((qvel[5] - 0.4).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::actuation::activation::advance_activations;
use crate::actuation::history;
use crate::inertia::row;
use crate::math::{add_scaled_slice, quat_conj, quat_integrate, quat_mul, quat_to_velocity};
use crate::model::reflected_load::dof_damping;
use crate::model::{Disable, JointType, Model};
use crate::sleep::{Awake, Subset, over};
use crate::stages::{Acceleration, Inertia, State, Transmission, Velocity};

/// True when some degree of freedom is damped and Euler treats that implicitly.
pub(crate) fn is_damped(m: &Model, dofs: Subset) -> bool {
    !m.opt.disableflags.intersects(Disable::EULERDAMP | Disable::DAMPER)
        && over!(dofs, |dofs| { dofs }.any(|dof| may_be_damped(m, dof)))
}

/// True when some degree of freedom may be damped, by itself or by an actuator.
pub(crate) fn has_joint_damping(m: &Model) -> bool {
    (0..m.nv).any(|dof| may_be_damped(m, dof))
}

#[inline]
fn may_be_damped(m: &Model, dof: usize) -> bool {
    m.dof_damping[dof] > 0.0
        || m.dof_dampingpoly[dof] != [0.0; 2]
        || m.jnt_actuatorid[m.dof_jntid[dof] as usize] != -1
}

/// `M + h B`, where `B` is the slope of joint damping at the present velocity.
pub(crate) fn damped_inertia(m: &Model, state: &State, inertia: &Inertia, out: &mut [f64]) {
    out.copy_from_slice(&inertia.M);
    (0..m.nv).for_each(|dof| damp(m, state, dof, out));
}

/// Adds the slope of the damping of a degree of freedom.
#[inline(always)]
pub(crate) fn damp(m: &Model, state: &State, dof: usize, out: &mut [f64]) {
    out[row(m, dof).end - 1] += m.opt.timestep * dof_damping(m, dof).slope(state.qvel[dof].abs());
}

/// Advances histories and activations by one step; `fresh` are the sensor readings of this step.
pub(crate) fn advance_memory(
    m: &Model,
    trn: &Transmission,
    vel: &Velocity,
    act_dot: &[f64],
    fresh: &[f64],
    state: &mut State,
) {
    if m.nhistory > 0 {
        history::record(m, &state.ctrl, fresh, state.time, &mut state.history);
    }
    if m.na > 0 && !m.opt.disableflags.contains(Disable::ACTUATION) {
        advance_activations(m, trn, vel, act_dot, state);
    }
}

/// Advances velocities, positions and time by one step, and states of plugins; keeps `qacc` to start the next solution.
/// Positions move with the velocity `qvel`, or with the new one.
pub(crate) fn advance_motion(
    m: &Model,
    acc: &Acceleration,
    qvel: Option<&[f64]>,
    qacc: &[f64],
    state: &mut State,
) {
    let h = m.opt.timestep;
    if Awake::of(m, state).is_everything() {
        add_scaled_slice(&mut state.qvel, qacc, h);
        integrate_pos(m, &mut state.qpos, qvel.unwrap_or(&state.qvel), h);
    } else {
        let State { qpos, qvel: own, body_awake, dof_awake_ind, nv_awake, .. } = state;
        dof_awake_ind[..*nv_awake].iter().for_each(|&dof| own[dof as usize] += qacc[dof as usize] * h);
        for j in (0..m.njnt).filter(|&j| body_awake[m.jnt_bodyid[j] as usize] != 0) {
            integrate_joint(m, j, qpos, qvel.unwrap_or(own), h);
        }
    }
    state.time += h;
    if m.npluginstate > 0 {
        advance_plugins(m, state);
    }
    state.qacc_warmstart.copy_from_slice(&acc.qacc);
}

/// Advances the states of plugins.
#[inline(never)]
fn advance_plugins(m: &Model, state: &mut State) {
    let mut own = std::mem::take(&mut state.plugin_state);
    for running in m.plugins().all() {
        running.instance.advance(m, state, &mut own[running.state.clone()]);
    }
    state.plugin_state = own;
}

/// Moves `qpos` with velocity `qvel` for `dt`: quaternions on the sphere, all else in a straight line.
pub fn integrate_pos(m: &Model, qpos: &mut [f64], qvel: &[f64], dt: f64) {
    for j in 0..m.njnt {
        integrate_joint(m, j, qpos, qvel, dt);
    }
}

#[inline(always)]
fn integrate_joint(m: &Model, j: usize, qpos: &mut [f64], qvel: &[f64], dt: f64) {
    let (q, v) = (m.jnt_qposadr[j] as usize, m.jnt_dofadr[j] as usize);
    match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Free) => {
            add_scaled_slice(&mut qpos[q..q + 3], &qvel[v..v + 3], dt);
            turn(&mut qpos[q + 3..q + 7], &qvel[v + 3..v + 6], dt);
        }
        Some(JointType::Ball) => turn(&mut qpos[q..q + 4], &qvel[v..v + 3], dt),
        Some(JointType::Slide | JointType::Hinge) | None => qpos[q] += dt * qvel[v],
    }
}

/// Velocity `out` that moves positions `from` to `to` in time `dt`, the inverse of `integrate_pos`.
pub fn differentiate_pos(m: &Model, from: &[f64], to: &[f64], dt: f64, out: &mut [f64]) {
    let quat = |qpos: &[f64], q: usize| [qpos[q], qpos[q + 1], qpos[q + 2], qpos[q + 3]];
    let turned = |q: usize| quat_to_velocity(quat_mul(quat_conj(quat(from, q)), quat(to, q)), dt);
    for j in 0..m.njnt {
        let (q, v) = (m.jnt_qposadr[j] as usize, m.jnt_dofadr[j] as usize);
        match JointType::from_code(m.jnt_type[j]) {
            Some(JointType::Free) => {
                (0..3).for_each(|k| out[v + k] = (to[q + k] - from[q + k]) / dt);
                out[v + 3..v + 6].copy_from_slice(&turned(q + 3));
            }
            Some(JointType::Ball) => out[v..v + 3].copy_from_slice(&turned(q)),
            Some(JointType::Slide | JointType::Hinge) | None => out[v] = (to[q] - from[q]) / dt,
        }
    }
}

fn turn(quat: &mut [f64], w: &[f64], dt: f64) {
    let turned = quat_integrate([quat[0], quat[1], quat[2], quat[3]], [w[0], w[1], w[2]], dt);
    quat.copy_from_slice(&turned);
}
