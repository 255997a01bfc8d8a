//! Numerical integration: semi-implicit Euler with implicit joint damping, Euler implicit in all smooth forces of
//! velocity, and fourth-order Runge-Kutta (MuJoCo documentation, Computation, "Numerical integration").

use crate::data::{Data, IntegrateScratch, Rates};
use crate::derivative::inputs_of;
use crate::inertia::{factor, factor_rows, row, solve_ld, solve_of};
use crate::integration::implicit;
use crate::integration::integrate::{
    advance_memory, advance_motion, damp, damped_inertia, integrate_pos, is_damped,
};
use crate::math::add_scaled_slice;
use crate::model::{Integrator, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::evaluate;
use crate::pipeline::rest::end_step;
use crate::pipeline::watch::{Stage, Watch};
use crate::sleep::{self, Awake, Subset};

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
        let crate::stages::Implicit { qH, qHDiagInv, .. } = &mut d.implicit;
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

/// Advances the state by the acceleration that the integrator found.
fn advance(m: &Model, d: &mut Data) {
    advance_memory(m, &d.trn, &d.vel, &d.actuation.act_dot, &d.scratch.sensor.fresh, &mut d.state);
    if sleep::is_on(m) {
        end_step(m, d);
    }
    advance_motion(m, &d.acc, None, &d.scratch.integrate.qacc, &mut d.state);
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
            end_step(m, d);
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
