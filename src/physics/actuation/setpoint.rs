//! The activations of an actuator and the setpoint that they may keep.

use crate::math::{clip, norm, ops};
use crate::model::bounds::MINVAL;
use crate::model::{BiasType, DynType, GainType, JointType, Model, TrnType};
use std::f64::consts::PI;

/// Position in `act` of the activations of actuator `i`.
pub fn activations(m: &Model, i: usize) -> std::ops::Range<usize> {
    let start = usize::try_from(m.actuator_actadr[i]).unwrap_or(0);
    start..start + m.actuator_actnum[i] as usize
}

/// Activation `act[k]` of actuator `i`, no motor, after one time step, within its range.
#[inline]
pub fn next_plain(m: &Model, i: usize, k: usize, act: &[f64], act_dot: f64) -> f64 {
    let act = act[k];
    let next = if m.actuator_dyntype[i] == DynType::Filterexact.code() {
        let tau = m.actuator_dynprm[i][0].max(MINVAL);
        act + act_dot * tau * (1.0 - ops::exp(-m.opt.timestep / tau))
    } else {
        act + act_dot * m.opt.timestep
    };
    if m.actuator_actlimited[i] { clip(next, m.actuator_actrange[i]) } else { next }
}

/// Period of the setpoint of a servo that turns a ball joint or a site about one axis; `None` for all others.
pub fn setpoint_period(m: &Model, i: usize) -> Option<f64> {
    let servo = m.actuator_gaintype[i] == GainType::Fixed.code()
        && m.actuator_biastype[i] == BiasType::Affine.code()
        && m.actuator_gainprm[i][0] == -m.actuator_biasprm[i][1]
        && matches!(DynType::from_code(m.actuator_dyntype[i]), Some(DynType::None | DynType::Integrator));
    if !servo && m.actuator_gaintype[i] != GainType::Pid.code() {
        return None;
    }
    let [x, y, z, rx, ry, rz] = m.actuator_gear[m.actuator_outadr[i] as usize];
    let axis = match TrnType::from_code(m.actuator_trntype[i])? {
        TrnType::Site if m.actuator_trnid[i][1] >= 0 && [x, y, z] == [0.0; 3] => [rx, ry, rz],
        TrnType::Joint | TrnType::Jointinparent
            if m.jnt_type[m.actuator_trnid[i][0] as usize] == JointType::Ball.code() =>
        {
            [x, y, z]
        }
        _ => return None,
    };
    Some(2.0 * PI * norm(axis)).filter(|&period| period > 0.0)
}

/// The equal of setpoint `u` nearest to `length`.
pub fn nearest_setpoint(u: f64, length: f64, period: f64) -> f64 {
    u - period * ((u - length) / period).round()
}

/// True when the group of actuator `i` is switched off.
pub fn is_disabled(m: &Model, i: usize) -> bool {
    let group = m.actuator_group[i];
    (0..=30).contains(&group) && m.opt.disableactuator & (1 << group) != 0
}
