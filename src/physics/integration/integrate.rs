//! Numerical integration: semi-implicit Euler with implicit joint damping, Euler implicit in all smooth forces of
//! velocity, and fourth-order Runge-Kutta (MuJoCo documentation, Computation, "Numerical integration").
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
use crate::actuation::reflected_load::dof_damping;
use crate::data::{Acceleration, Data, Inertia, State, Transmission, Velocity};
use crate::derivative::inputs_of;
use crate::inertia::{factor, factor_rows, row, solve_ld, solve_of};
use crate::integration::implicit;
use crate::math::{add_scaled_slice, quat_conj, quat_integrate, quat_mul, quat_to_velocity};
use crate::model::{Disable, Integrator, JointType, Model};
use crate::pipeline::forward::{StepError, evaluate};
use crate::pipeline::watch::{Stage, Watch};
use crate::sleep::{self, Awake, Subset, over};

/// Working memory of the integrators.
#[derive(Clone, Debug, Default)]
pub struct IntegrateScratch {
    qacc: Vec<f64>,
    force: Vec<f64>,
    start: Vec<f64>,
    qvel: Vec<f64>,
    act_dot: Vec<f64>,
    stages: [Rates; 4],
}

/// Rates of the state at one Runge-Kutta stage.
#[derive(Clone, Debug, Default)]
struct Rates {
    qvel: Vec<f64>,
    qacc: Vec<f64>,
    act_dot: Vec<f64>,
}

/// Whether an integrator recomputes its matrix factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// Recomputed at the present state.
    Fresh,
    /// As the last step left them.
    Kept,
}

/// Advances the state by one step of the model's integrator; `forward` has been called at the present state.
///
/// # Errors
/// An intermediate state cannot be evaluated.
pub(crate) fn integrate(
    m: &Model,
    d: &mut Data,
    factors: Factors,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    if m.opt.integrator == Integrator::Rk4 {
        return runge_kutta(m, d, watch);
    }
    advance_once(m, d, factors);
    Ok(())
}

/// The same without intermediate states: Euler's method stands in for Runge-Kutta.
pub(crate) fn advance_once(m: &Model, d: &mut Data, factors: Factors) {
    match m.opt.integrator {
        Integrator::Implicit | Integrator::Implicitfast => implicit(m, d, factors),
        Integrator::Euler | Integrator::Rk4 => euler(m, d, factors),
    }
}

/// Advances the state by one step of Euler's method with forces taken at the new velocity, to first order.
pub fn implicit(m: &Model, d: &mut Data, factors: Factors) {
    if d.metric.is_on() {
        // The stiffness of flexes at the end of the step is in the acceleration already.
        d.scratch.integrate.qacc.clone_from(&d.acc.qacc);
        advance(m, d);
        return;
    }
    let inputs = inputs_of!(d);
    if factors == Factors::Fresh {
        implicit::factor(m, &inputs, &mut d.implicit, &mut d.scratch.implicit);
    }
    let IntegrateScratch { qacc, force, .. } = &mut d.scratch.integrate;
    force.clear();
    force.extend(d.acc.qfrc_smooth.iter().zip(&d.acc.qfrc_constraint).map(|(s, c)| s + c));
    qacc.resize(m.nv, 0.0);
    implicit::solve(m, &inputs, &d.implicit, force, qacc);
    advance(m, d);
}

/// Advances the state by one step of semi-implicit Euler; joint damping is taken at the end of the step.
pub fn euler(m: &Model, d: &mut Data, factors: Factors) {
    let (qacc, awake) = (&mut d.scratch.integrate.qacc, Awake::of(m, &d.state).dofs(m));
    qacc.clear();
    if is_damped(m, awake) {
        let crate::data::Implicit { qH, qHDiagInv, .. } = &mut d.implicit;
        qacc.extend(d.acc.qfrc_smooth.iter().zip(&d.acc.qfrc_constraint).map(|(s, c)| s + c));
        match awake {
            Subset::All(_) => {
                if factors == Factors::Fresh {
                    damped_inertia(m, &d.state, &d.inertia, qH);
                    factor(m, qH, qHDiagInv);
                }
                solve_ld(m, qH, qHDiagInv, qacc);
            }
            Subset::Listed(dofs) => {
                let rows = || dofs.iter().map(|&dof| dof as usize);
                for dof in rows() {
                    qH[row(m, dof)].copy_from_slice(&d.inertia.M[row(m, dof)]);
                    damp(m, &d.state, dof, qH);
                }
                factor_rows(m, qH, qHDiagInv, rows());
                solve_of(m, dofs, qH, qHDiagInv, qacc);
            }
        }
    } else {
        qacc.extend_from_slice(&d.acc.qacc);
    }
    advance(m, d);
}

/// True when some degree of freedom is damped and Euler treats that implicitly.
fn is_damped(m: &Model, dofs: Subset) -> bool {
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
fn damp(m: &Model, state: &State, dof: usize, out: &mut [f64]) {
    out[row(m, dof).end - 1] += m.opt.timestep * dof_damping(m, dof).slope(state.qvel[dof].abs());
}

/// Advances the state by the acceleration that the integrator found.
fn advance(m: &Model, d: &mut Data) {
    advance_memory(m, &d.trn, &d.vel, &d.actuation.act_dot, &d.scratch.sensor.fresh, &mut d.state);
    if sleep::is_on(m) {
        sleep::rest::end_step(m, d);
    }
    advance_motion(m, &d.acc, None, &d.scratch.integrate.qacc, &mut d.state);
}

/// Advances histories and activations by one step; `fresh` are the sensor readings of this step.
fn advance_memory(
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
fn advance_motion(m: &Model, acc: &Acceleration, qvel: Option<&[f64]>, qacc: &[f64], state: &mut State) {
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

/// Weights of the previous stage's rates at stages 1 to 3, and of all stages in the step (classical tableau).
const STAGE: [f64; 3] = [0.5, 0.5, 1.0];
const STEP: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Advances the state by one classical Runge-Kutta step. `evaluate` has been called at the present state.
///
/// # Errors
/// An intermediate state cannot be evaluated.
pub fn runge_kutta(m: &Model, d: &mut Data, watch: &mut impl Watch) -> Result<(), StepError> {
    let mut scratch = std::mem::take(&mut d.scratch.integrate);
    let result = stages(m, d, &mut scratch, watch);
    if result.is_ok() {
        combine(&mut scratch, m);
        advance_memory(m, &d.trn, &d.vel, &scratch.act_dot, &d.scratch.sensor.fresh, &mut d.state);
        if sleep::is_on(m) {
            sleep::rest::end_step(m, d);
        }
        advance_motion(m, &d.acc, Some(&scratch.qvel), &scratch.qacc, &mut d.state);
    }
    d.scratch.integrate = scratch;
    result
}

/// Evaluates the four stages; leaves the state as it was before.
fn stages(
    m: &Model,
    d: &mut Data,
    s: &mut IntegrateScratch,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    let (h, time) = (m.opt.timestep, d.state.time);
    let IntegrateScratch { start, stages, .. } = s;
    start.clear();
    for part in [&d.state.qpos, &d.state.qvel, &d.state.act] {
        start.extend_from_slice(part);
    }
    stages[0].read(d);
    let mut result = Ok(());
    for (i, weight) in STAGE.into_iter().enumerate() {
        restore(m, d, start);
        let last = &stages[i];
        integrate_pos(m, &mut d.state.qpos, &last.qvel, weight * h);
        for (x, rate) in d.state.qvel.iter_mut().zip(&last.qacc) {
            *x += h * (weight * rate);
        }
        for (x, rate) in d.state.act.iter_mut().zip(&last.act_dot) {
            *x += h * (weight * rate);
        }
        d.state.time = time + weight * h;
        watch.ended(Stage::Integration);
        result = evaluate(m, d, false, watch);
        if result.is_err() {
            break;
        }
        stages[i + 1].read(d);
    }
    restore(m, d, start);
    d.state.time = time;
    result
}

impl Rates {
    fn read(&mut self, d: &Data) {
        for (to, from) in [
            (&mut self.qvel, &d.state.qvel),
            (&mut self.qacc, &d.acc.qacc),
            (&mut self.act_dot, &d.actuation.act_dot),
        ] {
            to.clear();
            to.extend_from_slice(from);
        }
    }
}

fn restore(m: &Model, d: &mut Data, start: &[f64]) {
    d.state.qpos.copy_from_slice(&start[..m.nq]);
    d.state.qvel.copy_from_slice(&start[m.nq..m.nq + m.nv]);
    d.state.act.copy_from_slice(&start[m.nq + m.nv..]);
}

/// Weighted mean of the rates of all stages.
fn combine(s: &mut IntegrateScratch, m: &Model) {
    let IntegrateScratch { qacc, qvel, act_dot, stages, .. } = s;
    for (mean, n) in [(&mut *qvel, m.nv), (&mut *qacc, m.nv), (&mut *act_dot, m.na)] {
        mean.clear();
        mean.resize(n, 0.0);
    }
    for (stage, weight) in stages.iter().zip(STEP) {
        add_scaled_slice(qvel, &stage.qvel, weight);
        add_scaled_slice(qacc, &stage.qacc, weight);
        add_scaled_slice(act_dot, &stage.act_dot, weight);
    }
}
