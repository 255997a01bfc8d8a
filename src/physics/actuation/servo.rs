//! Controllers inside actuators: their inputs, slew limits, and the servo with integral of `pid`
//! (XML reference: `actuator/pid`).

use crate::actuation::setpoint::{activations, nearest_setpoint, next_plain, setpoint_period};
use crate::math::clip;
use crate::model::input::{FEED_FORWARD, POSITION, VELOCITY, VOLTAGE};
use crate::model::{DynType, GainType, Model};

/// Position, velocity, feed-forward and voltage inputs of actuator `i`, zero where it has none; the first control
/// is limited in slew.
pub fn inputs(m: &Model, act: &[f64], i: usize, ctrl: impl Fn(usize) -> f64) -> [f64; 4] {
    let mut next = m.actuator_ctrladr[i] as usize;
    let first = next;
    [POSITION, VELOCITY, FEED_FORWARD, VOLTAGE].map(|bit| {
        if m.actuator_ctrlspec[i] & bit == 0 {
            return 0.0;
        }
        next += 1;
        if next - 1 == first { slewed(m, act, i, ctrl(first)) } else { ctrl(next - 1) }
    })
}

/// Largest rate of the setpoint of actuator `i`; 0 for any.
fn slew(m: &Model, i: usize) -> f64 {
    match DynType::from_code(m.actuator_dyntype[i]) {
        Some(DynType::Pid) => m.actuator_dynprm[i][1],
        Some(DynType::Dcmotor) => m.actuator_dynprm[i][7],
        _ => 0.0,
    }
}

/// Setpoint `u`, or as near to it as the last one, kept as the first activation, may move in a step.
fn slewed(m: &Model, act: &[f64], i: usize, u: f64) -> f64 {
    let slew = slew(m, i);
    if slew <= 0.0 {
        return u;
    }
    let last = act[activations(m, i).start];
    let period = setpoint_period(m, i).filter(|_| m.actuator_gaintype[i] == GainType::Pid.code());
    let u = period.map_or(u, |period| nearest_setpoint(u, last, period));
    let reach = slew * m.opt.timestep;
    clip(u, [last - reach, last + reach])
}

/// Rate of the setpoint kept as an activation; `None` where slew is free.
pub fn slew_rate(m: &Model, act: &[f64], i: usize, u: f64) -> Option<f64> {
    let last = act[activations(m, i).start];
    (slew(m, i) > 0.0).then(|| (slewed(m, act, i, u) - last) / m.opt.timestep)
}

/// Rate `error` of an integral `z`, which does not grow past `most`; 0 for any size.
pub fn integral_rate(error: f64, z: f64, most: f64) -> f64 {
    if most > 0.0 && z >= most {
        error.min(0.0)
    } else if most > 0.0 && z <= -most {
        error.max(0.0)
    } else {
        error
    }
}

/// Rates of the states of a `pid` servo: setpoint, integral of the error.
pub fn pid_rates(
    m: &Model,
    act: &[f64],
    i: usize,
    length: f64,
    ctrl: impl Fn(usize) -> f64,
    act_dot: &mut [f64],
) {
    let mut slot = activations(m, i).start;
    let first = ctrl(m.actuator_ctrladr[i] as usize);
    if let Some(rate) = slew_rate(m, act, i, first) {
        act_dot[slot] = rate;
        slot += 1;
    }
    if m.actuator_gainprm[i][0] > 0.0 {
        let mut error = slewed(m, act, i, first) - length;
        if let Some(period) = setpoint_period(m, i) {
            error -= period * (error / period).round();
        }
        act_dot[slot] = integral_rate(error, act[slot], m.actuator_dynprm[i][0]);
    }
}

/// Part of the force of a `pid` servo that its inputs and its integral make; the bias has the rest.
///
/// Not inlined, so that the addresses of its arrays are loaded only where such an actuator exists.
#[inline(never)]
pub fn pid_force(
    m: &Model,
    act: &[f64],
    i: usize,
    length: f64,
    ctrl: impl Fn(usize) -> f64,
    act_dot: &[f64],
) -> f64 {
    let prm = &m.actuator_biasprm[i];
    let [mut position, velocity, feed_forward, _] = inputs(m, act, i, ctrl);
    if let Some(period) = setpoint_period(m, i) {
        position = nearest_setpoint(position, length, period);
    }
    let mut force = -prm[1] * position - prm[2] * velocity + feed_forward;
    let ki = m.actuator_gainprm[i][0];
    if let Some(k) = activations(m, i).last().filter(|_| ki > 0.0) {
        let early = m.actuator_actearly[i];
        force += ki * if early { next_plain(m, i, k, act, act_dot[k]) } else { act[k] };
    }
    force
}
