//! Inverse dynamics: the force that makes a given acceleration, constraints included (MuJoCo documentation,
//! Computation, "Inverse dynamics"). Constraint forces follow from the acceleration row by row, without iteration.
//!
//! ```
//! use robohive_physics::{Data, inverse};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! // What force holds a kilogram still?
//! let mut data = Data::new(&model);
//! data.acc.qacc.fill(0.0);
//! inverse(&model, &mut data)?;
//! assert!((data.implicit.qfrc_inverse[2] - 9.81).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::Data;
use crate::derivative::inputs_of;
use crate::flex::Poses;
use crate::inertia::{mul_inertia_matrix, solve};
use crate::integration::implicit;
use crate::integration::integrate::{damped_inertia, has_joint_damping};
use crate::math::dense::norm_slice;
use crate::model::NotSimulated;
use crate::model::{Disable, Enable, Integrator, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::{Known, acceleration_sensors, position_and_velocity};
use crate::position::jacobian::apply_user_wrenches;
use crate::solver;

/// Computes `qfrc_inverse`, the sum of applied and actuator forces that makes `qacc` at the present state, with the
/// constraint forces that go with it. With the flag `invdiscrete`, `qacc` is the change of velocity over one step of
/// the model's integrator, divided by the time step.
///
/// # Errors
/// The model uses what is not simulated, or asks for discrete inverse dynamics of Runge-Kutta.
pub fn inverse(m: &Model, d: &mut Data) -> Result<(), StepError> {
    inverse_after(m, d, Known::Nothing, true)
}

/// `inverse` where part of the last evaluation still holds, with or without sensors.
///
/// # Errors
/// As [`inverse`].
#[doc(hidden)]
pub fn inverse_after(m: &Model, d: &mut Data, known: Known, sensors: bool) -> Result<(), StepError> {
    position_and_velocity(m, d, known, sensors, &mut ())?;
    let mut s = std::mem::take(&mut d.scratch.inverse);
    s.given.clone_from(&d.acc.qacc);
    let mut result = Ok(());
    if m.opt.enableflags.contains(Enable::INVDISCRETE) {
        result = continuous_acceleration(m, d, &mut s.force);
    }
    if result.is_ok() {
        solver::constraint_force(m, &d.con, &mut d.efc, &mut d.acc, &mut d.scratch.solver);
        if sensors {
            acceleration_sensors(m, d);
        }
        s.force.clear();
        s.force.resize(m.nv, 0.0);
        mul_inertia_matrix(m, &d.inertia.M, &d.acc.qacc, &mut s.force);
        if d.metric.is_on() {
            let effective = d.metric.effective(m, Poses { kin: &d.kin, com: &d.com }, &d.flex, &d.inertia);
            effective.add_product(&d.acc.qacc, &mut s.force);
            s.force.iter_mut().zip(effective.shift()).for_each(|(f, shift)| *f -= shift);
        }
        for (dof, inertial) in s.force.iter().enumerate() {
            d.implicit.qfrc_inverse[dof] =
                d.vel.qfrc_bias[dof] + (inertial - d.passive.qfrc_passive[dof] - d.acc.qfrc_constraint[dof]);
        }
    }
    d.acc.qacc.copy_from_slice(&s.given);
    d.scratch.inverse = s;
    result
}

/// Replaces `qacc`, taken as change of velocity over a step, by the acceleration from which the integrator makes it.
fn continuous_acceleration(m: &Model, d: &mut Data, force: &mut Vec<f64>) -> Result<(), StepError> {
    force.clear();
    force.resize(m.nv, 0.0);
    match m.opt.integrator {
        Integrator::Rk4 => {
            return Err(NotSimulated::feature("discrete inverse dynamics of the integrator RK4").into());
        }
        Integrator::Euler => {
            // Dampers that are switched off count here too, as upstream.
            if m.opt.disableflags.contains(Disable::EULERDAMP) || !has_joint_damping(m) {
                return Ok(());
            }
            damped_inertia(m, &d.state, &d.inertia, &mut d.implicit.qH);
            mul_inertia_matrix(m, &d.implicit.qH, &d.acc.qacc, force);
        }
        Integrator::Implicit | Integrator::Implicitfast => {
            let inputs = inputs_of!(d);
            implicit::mul(m, &inputs, &mut d.implicit, &mut d.scratch.implicit, &d.acc.qacc, force);
        }
    }
    d.acc.qacc.copy_from_slice(force);
    solve(m, &d.inertia, &mut d.acc.qacc);
    Ok(())
}

/// Compares forward with inverse dynamics after `forward`, into `solver_fwdinv`: the norms of the differences in
/// constraint force and in applied force. Zero without constraints.
///
/// # Errors
/// As `inverse`.
pub fn compare_with_forward(m: &Model, d: &mut Data) -> Result<(), StepError> {
    d.solver.solver_fwdinv = [0.0; 2];
    if d.efc.nefc == 0 {
        return Ok(());
    }
    let mut constraint = std::mem::take(&mut d.scratch.inverse.forward_constraint);
    let mut rows = std::mem::take(&mut d.scratch.inverse.forward_rows);
    constraint.clone_from(&d.acc.qfrc_constraint);
    rows.clone_from(&d.efc.efc_force);
    let result = inverse_after(m, d, Known::Velocity, false);
    let difference = &mut d.scratch.inverse.force;
    difference.clear();
    difference.extend(constraint.iter().zip(&d.acc.qfrc_constraint).map(|(a, b)| a - b));
    d.solver.solver_fwdinv[0] = norm_slice(difference);
    difference.clear();
    difference.extend(d.state.qfrc_applied.iter().zip(&d.actuation.qfrc_actuator).map(|(a, b)| a + b));
    apply_user_wrenches(m, &d.kin, &d.com, &d.state.xfrc_applied, difference);
    difference.iter_mut().zip(&d.implicit.qfrc_inverse).for_each(|(a, b)| *a -= b);
    d.solver.solver_fwdinv[1] = norm_slice(difference);
    d.acc.qfrc_constraint.copy_from_slice(&constraint);
    d.efc.efc_force.copy_from_slice(&rows);
    d.scratch.inverse.forward_constraint = constraint;
    d.scratch.inverse.forward_rows = rows;
    result
}
