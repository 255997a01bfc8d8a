//! DC motors: armature circuit, on-board controller, heating, cogging and bristle friction
//! (documentation: Computation, "DC motor"; LuGre friction after Canudas de Wit et al. 1995).
//!
//! Parameters in `actuator_gainprm`: resistance, motor constant, temperature coefficient, its reference
//! temperature, kp, ki, kd, supply voltage; in `actuator_dynprm`: electrical time constant, limit of the current's
//! rate, thermal resistance, thermal capacity, ambient temperature, stiffness and damping of the bristles, slew
//! rate, bound of the integral; in `actuator_biasprm`: amplitude, periods and phase of cogging, Coulomb friction,
//! static friction, Stribeck velocity.

use crate::actuation::servo;
use crate::actuation::setpoint::activations;
use crate::math::{clip, ops};
use crate::model::bounds::MINVAL;
use crate::model::input::{FEED_FORWARD, POSITION, VELOCITY, VOLTAGE};
use crate::model::{BiasType, DynType, GainType, Model};

/// Places of the optional states among the activations of a motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slots {
    slew: Option<usize>,
    integral: Option<usize>,
    temperature: Option<usize>,
    bristle: Option<usize>,
    current: Option<usize>,
    /// How many states there are.
    pub count: usize,
}

/// The states that the parameters of a motor ask for.
pub fn slots(gainprm: &[f64; 10], dynprm: &[f64; 10]) -> Slots {
    let mut slots = Slots::default();
    let mut next = |wanted: bool| {
        let slot = slots.count;
        slots.count += usize::from(wanted);
        wanted.then_some(slot)
    };
    let places =
        [dynprm[7] > 0.0, gainprm[5] > 0.0, dynprm[2] > 0.0, dynprm[5] > 0.0, dynprm[0] > 0.0].map(&mut next);
    let [slew, integral, temperature, bristle, current] = places;
    Slots { slew, integral, temperature, bristle, current, ..slots }
}

/// True when actuator `i` is no motor in any respect, or in every one with the activations its parameters ask for.
pub fn fits(m: &Model, i: usize) -> bool {
    let motor = [
        m.actuator_dyntype[i] == DynType::Dcmotor.code(),
        m.actuator_gaintype[i] == GainType::Dcmotor.code(),
        m.actuator_biastype[i] == BiasType::Dcmotor.code(),
    ];
    motor == [false; 3] || motor == [true; 3] && slots_of(m, i).count == m.actuator_actnum[i] as usize
}

fn slots_of(m: &Model, i: usize) -> Slots {
    slots(&m.actuator_gainprm[i], &m.actuator_dynprm[i])
}

/// A state of motor `i`; `None` when it has no such state.
fn state(m: &Model, act: &[f64], i: usize, slot: Option<usize>) -> Option<f64> {
    slot.map(|slot| act[activations(m, i).start + slot])
}

fn has_controller(m: &Model, i: usize) -> bool {
    m.actuator_ctrlspec[i] & (POSITION | VELOCITY | FEED_FORWARD) != 0
}

/// Resistance at the temperature of the winding.
fn resistance(m: &Model, act: &[f64], i: usize) -> f64 {
    let [r, _, alpha, reference, ..] = m.actuator_gainprm[i];
    match state(m, act, i, slots_of(m, i).temperature) {
        Some(rise) => r * (1.0 + alpha * (rise + m.actuator_dynprm[i][4] - reference)),
        None => r,
    }
}

/// Voltage at the terminals: the controller's voltage plus the commanded one.
fn voltage(m: &Model, act: &[f64], i: usize, length: f64, velocity: f64, ctrl: impl Fn(usize) -> f64) -> f64 {
    let [position, speed, feed_forward, raw] = servo::inputs(m, act, i, ctrl);
    if !has_controller(m, i) {
        return raw;
    }
    let [r, k, _, _, kp, ki, kd, most, ..] = m.actuator_gainprm[i];
    let integral = state(m, act, i, slots_of(m, i).integral).unwrap_or(0.0);
    let torque = kp * (position - length) + kd * (speed - velocity) + ki * integral + feed_forward;
    let voltage = r / k * torque + k * velocity;
    (if most > 0.0 { clip(voltage, [-most, most]) } else { voltage }) + raw
}

/// Friction at steady velocity (Stribeck curve).
fn stribeck(m: &Model, i: usize, velocity: f64) -> f64 {
    let [_, _, _, coulomb, stick, scale, ..] = m.actuator_biasprm[i];
    let ratio = velocity / scale.max(MINVAL);
    coulomb + (stick - coulomb) * ops::exp(-ratio * ratio)
}

/// Decay rate of the bristles' deflection, negative.
fn bristle_decay(m: &Model, i: usize, velocity: f64) -> f64 {
    -m.actuator_dynprm[i][5] * velocity.abs() / stribeck(m, i, velocity).max(MINVAL)
}

/// Rates of the states of motor `i`.
pub fn rates(
    m: &Model,
    act: &[f64],
    i: usize,
    (length, velocity): (f64, f64),
    ctrl: impl Fn(usize) -> f64,
    act_dot: &mut [f64],
) {
    let (slots, first, prm) = (slots_of(m, i), activations(m, i).start, &m.actuator_dynprm[i]);
    let constant = m.actuator_gainprm[i][1];
    let inputs = servo::inputs(m, act, i, &ctrl);
    if let Some(slot) = slots.slew {
        let u = ctrl(m.actuator_ctrladr[i] as usize);
        act_dot[first + slot] = servo::slew_rate(m, act, i, u).unwrap_or(0.0);
    }
    if let Some(slot) = slots.integral {
        act_dot[first + slot] = servo::integral_rate(inputs[0] - length, act[first + slot], prm[8]);
    }
    let volts = voltage(m, act, i, length, velocity, ctrl);
    let r = resistance(m, act, i);
    if let Some(slot) = slots.temperature {
        let current = state(m, act, i, slots.current).unwrap_or_else(|| (volts - constant * velocity) / r);
        act_dot[first + slot] = (r * current * current - act[first + slot] / prm[2]) / prm[3];
    }
    if let Some(slot) = slots.bristle {
        act_dot[first + slot] = bristle_decay(m, i, velocity) * act[first + slot] + velocity;
    }
    if let Some(slot) = slots.current {
        let rate = (volts / r - constant / r * velocity - act[first + slot]) / prm[0];
        act_dot[first + slot] = if prm[1] > 0.0 { clip(rate, [-prm[1], prm[1]]) } else { rate };
    }
}

/// State `k` of motor `i` after one time step: exact for current and bristles at constant velocity.
pub fn next_state(m: &Model, i: usize, k: usize, act: f64, act_dot: f64, velocity: f64) -> f64 {
    let (slots, h, prm) = (slots_of(m, i), m.opt.timestep, &m.actuator_dynprm[i]);
    let slot = Some(k - activations(m, i).start);
    if slot == slots.current {
        let te = prm[0].max(MINVAL);
        act + act_dot * te * (1.0 - ops::exp(-h / te))
    } else if slot == slots.bristle {
        let a = bristle_decay(m, i, velocity);
        let decay = ops::exp(a * h);
        decay * act + if a.abs() > MINVAL { (decay - 1.0) / a } else { h } * velocity
    } else if slot == slots.integral && prm[8] > 0.0 {
        clip(act + act_dot * h, [-prm[8], prm[8]])
    } else {
        act + act_dot * h
    }
}

/// Torque of the current in motor `i`.
///
/// Not inlined, so that the addresses of its arrays are loaded only where such an actuator exists.
#[inline(never)]
pub fn electrical_force(
    m: &Model,
    act: &[f64],
    i: usize,
    (length, velocity): (f64, f64),
    ctrl: impl Fn(usize) -> f64,
    act_dot: &[f64],
) -> f64 {
    let constant = m.actuator_gainprm[i][1];
    if let Some(slot) = slots_of(m, i).current {
        let k = activations(m, i).start + slot;
        let early = m.actuator_actearly[i];
        return constant * if early { next_state(m, i, k, act[k], act_dot[k], velocity) } else { act[k] };
    }
    let gain = constant / resistance(m, act, i).max(MINVAL);
    let volts = match m.actuator_ctrlspec[i] {
        _ if m.actuator_ctrlnum[i] == 0 => 0.0,
        VOLTAGE => ctrl(m.actuator_ctrladr[i] as usize),
        _ => voltage(m, act, i, length, velocity, ctrl),
    };
    gain * volts - gain * constant * velocity
}

/// Adds torques that no limit of the current bounds: cogging and friction.
pub fn add_mechanical_force(m: &Model, act: &[f64], i: usize, length: f64, act_dot: &[f64], force: &mut f64) {
    let [amplitude, periods, phase, ..] = m.actuator_biasprm[i];
    if amplitude != 0.0 {
        *force += amplitude * ops::sin(periods * length + phase);
    }
    if let Some(slot) = slots_of(m, i).bristle {
        let k = activations(m, i).start + slot;
        *force -= m.actuator_dynprm[i][5] * act[k] + m.actuator_dynprm[i][6] * act_dot[k];
    }
}

/// Slope of the force of motor `i` over velocity; heating, supply limit and the bristles' state are not seen.
pub fn slope(m: &Model, i: usize) -> f64 {
    let ([r, k, ..], kd, prm) = (m.actuator_gainprm[i], m.actuator_gainprm[i][6], &m.actuator_dynprm[i]);
    let r = r.max(MINVAL);
    let controller = if has_controller(m, i) { -kd * r / k + k } else { 0.0 };
    let te = prm[0];
    let mut slope = if te > 0.0 {
        k * (controller - k) * (1.0 - ops::exp(-m.opt.timestep / te)) / r
    } else {
        let back_emf = -(k * k / r);
        if controller != 0.0 { back_emf + k * controller / r } else { back_emf }
    };
    if prm[6] > 0.0 {
        slope -= prm[6];
    }
    slope
}
