//! Activation dynamics of stateful actuators (documentation: Computation, "Actuation model").

use crate::actuation::dc_motor;
use crate::actuation::muscle;
use crate::actuation::servo;
use crate::actuation::setpoint::{activations, is_disabled, nearest_setpoint, next_plain, setpoint_period};
use crate::math::norm;
use crate::model::bounds::MINVAL;
use crate::model::{DynType, GainType, Model};
use crate::sleep::{Awake, object};
use crate::stages::{State, Transmission, Velocity};
use std::f64::consts::PI;

/// Time derivative of the activations of all actuators that do not sleep, under the clamped controls `ctrl(k)`.
pub fn activation_rates(
    m: &Model,
    state: &State,
    trn: &Transmission,
    vel: &Velocity,
    ctrl: impl Fn(usize) -> f64,
    act_dot: &mut [f64],
) {
    let (act, awake) = (&state.act[..], Awake::of(m, state));
    for i in (0..m.nactuator).filter(|&i| !awake.skips(|state| object::actuator(m, state, i))) {
        let at = activations(m, i);
        let Some(last) = at.clone().last() else { continue };
        let (first_input, prm) = (m.actuator_ctrladr[i] as usize, &m.actuator_dynprm[i]);
        act_dot[at].fill(0.0);
        match DynType::from_code(m.actuator_dyntype[i]) {
            Some(DynType::Integrator) => {
                let inputs = m.actuator_ctrlnum[i] as usize;
                (0..inputs).for_each(|j| act_dot[last + 1 - inputs + j] = ctrl(first_input + j));
            }
            Some(DynType::Filter | DynType::Filterexact) => {
                act_dot[last] = (ctrl(first_input) - act[last]) / prm[0].max(MINVAL);
            }
            Some(DynType::Muscle) => {
                act_dot[last] = muscle::activation_rate(ctrl(first_input), act[last], prm)
            }
            // Those of users rest; the others are refused by `validity::check_model`.
            Some(DynType::None | DynType::User) | None => {}
            Some(DynType::Pid) => {
                let length = trn.actuator_length[m.actuator_outadr[i] as usize];
                servo::pid_rates(m, act, i, length, &ctrl, act_dot);
            }
            Some(DynType::Dcmotor) => {
                let out = m.actuator_outadr[i] as usize;
                let motion = (trn.actuator_length[out], vel.actuator_velocity[out]);
                dc_motor::rates(m, act, i, motion, &ctrl, act_dot);
            }
        }
    }
}

/// Activation `act[k]` of actuator `i`, which moves at `velocity`, after one time step, within its range.
#[inline]
pub fn next_activation(m: &Model, i: usize, k: usize, act: &[f64], act_dot: f64, velocity: f64) -> f64 {
    if m.actuator_dyntype[i] == DynType::Dcmotor.code() {
        return dc_motor::next_state(m, i, k, act[k], act_dot, velocity);
    }
    next_plain(m, i, k, act, act_dot)
}

/// Advances all activations by one time step, except of disabled actuators.
pub fn advance_activations(
    m: &Model,
    trn: &Transmission,
    vel: &Velocity,
    act_dot: &[f64],
    state: &mut State,
) {
    for i in 0..m.nactuator {
        let enabled = !is_disabled(m, i);
        let velocity = vel.actuator_velocity[m.actuator_outadr[i] as usize];
        for k in activations(m, i) {
            let rate = if enabled { act_dot[k] } else { 0.0 };
            state.act[k] = next_activation(m, i, k, &state.act, rate, velocity);
        }
        if m.actuator_dyntype[i] == DynType::Integrator.code() {
            rewind_setpoint(m, trn, i, &mut state.act);
        }
    }
}

/// Replaces a rotational setpoint kept in `act` by its equal nearest the present angle.
fn rewind_setpoint(m: &Model, trn: &Transmission, i: usize, act: &mut [f64]) {
    let at = activations(m, i);
    if let (Some(period), Some(last)) = (setpoint_period(m, i), at.clone().last()) {
        act[last] = nearest_setpoint(act[last], trn.actuator_length[m.actuator_outadr[i] as usize], period);
    } else if m.actuator_gaintype[i] == GainType::So3.code() {
        let vector = &mut act[at.start..at.start + 3];
        let angle = norm([vector[0], vector[1], vector[2]]);
        if angle > PI {
            let factor = (angle - 2.0 * PI * (angle / (2.0 * PI)).round()) / angle;
            vector.iter_mut().for_each(|x| *x *= factor);
        }
    }
}
