//! Actuator forces: `gain · input + bias`, limited per actuator, tendon and joint (documentation: Computation,
//! "Actuation model"). The input is the control or the activation.

pub(crate) mod activation;
pub(crate) mod dc_motor;
pub(crate) mod history;
#[doc(hidden)]
pub mod muscle;
pub(crate) mod servo;
pub(crate) mod setpoint;
pub mod transmission;
pub mod user;

pub use history::{Recorded, recall};

pub use setpoint::is_disabled;

use crate::actuation::activation::{activation_rates, next_activation};
use crate::actuation::muscle::Muscle;
use crate::actuation::setpoint::{activations, nearest_setpoint, setpoint_period};
use crate::actuation::transmission::moment;
use crate::actuation::user::{Unset, UserActuators};
use crate::math::{
    IDENTITY, Quat, Vec3, clip, norm, quat_difference, quat_from_axis_angle, quat_normalize, scale,
};
use crate::model::bounds::{MAXVAL, MINVAL};
use crate::model::{
    ActuatorInputs, BiasType, Capability, Disable, DynType, GainType, JointType, Model, TrnType, input,
};
use crate::sleep::{Awake, object};
use crate::stages::{Actuation, Passive, State, Transmission, Velocity};
use crate::velocity::passive::has_gravity_compensation;

/// Computes rates of activation, actuator forces, and their sum in joint space.
pub fn actuation(
    m: &Model,
    state: &State,
    trn: &Transmission,
    vel: &Velocity,
    passive: &Passive,
    out: &mut Actuation,
) {
    let inputs = ActuatorInputs { m, state, trn, vel };
    if let Some(bad) = all_rates(&inputs, out) {
        all_forces(&inputs, bad, &Unset, passive, out);
    }
}

/// The first half of [`actuation`]: rates of activation; forces are zero.
pub fn rates(inputs: &ActuatorInputs, out: &mut Actuation) {
    all_rates(inputs, out);
}

/// The second half of [`actuation`]: forces under the rates of activation in `out`, where `user` has gains and biases of
/// type `user`.
pub fn forces(inputs: &ActuatorInputs, user: &impl UserActuators, passive: &Passive, out: &mut Actuation) {
    if clear(inputs.m, out) {
        all_forces(inputs, any_is_bad(inputs), user, passive, out);
    }
}

/// Sets forces to zero; whether there is something that may act.
#[inline(always)]
fn clear(m: &Model, out: &mut Actuation) -> bool {
    out.actuator_force.fill(0.0);
    out.qfrc_actuator.fill(0.0);
    m.nactuator > 0 && !m.opt.disableflags.contains(Disable::ACTUATION)
}

/// Whether a control is not finite or too large: one bad control switches all of them off.
#[inline(always)]
fn any_is_bad(inputs: &ActuatorInputs) -> bool {
    let is_bad = |u: f64| u.is_nan() || u.abs() > MAXVAL;
    (0..inputs.m.nu).any(|k| is_bad(clamped_control(inputs.m, inputs.state, k)))
}

/// [`rates`]; whether a control is bad, `None` where nothing acts.
#[inline(always)]
fn all_rates(inputs: &ActuatorInputs, out: &mut Actuation) -> Option<bool> {
    let &ActuatorInputs { m, state, trn, vel } = inputs;
    if !clear(m, out) {
        return None;
    }
    let bad = any_is_bad(inputs);
    let ctrl = |k: usize| if bad { 0.0 } else { clamped_control(m, state, k) };
    activation_rates(m, state, trn, vel, ctrl, &mut out.act_dot);
    if m.nplugin > 0 {
        for (_, running) in m.plugins().with(Capability::Actuator) {
            running.instance.activation_rates(inputs, &mut out.act_dot);
        }
    }
    Some(bad)
}

#[inline(always)]
fn all_forces(
    inputs: &ActuatorInputs,
    bad: bool,
    user: &impl UserActuators,
    passive: &Passive,
    out: &mut Actuation,
) {
    let &ActuatorInputs { m, state, trn, vel } = inputs;
    let ctrl = |k: usize| if bad { 0.0 } else { clamped_control(m, state, k) };
    let awake = Awake::of(m, state);
    let without_plugins = m.nplugin == 0;
    let works = |i: usize| {
        !is_disabled(m, i)
            && (without_plugins || m.actuator_plugin[i] < 0)
            && !awake.skips(|state| object::actuator(m, state, i))
    };
    for i in (0..m.nactuator).filter(|&i| works(i)) {
        let first = m.actuator_outadr[i] as usize;
        if m.actuator_gaintype[i] == GainType::So3.code() {
            let force = orientation_servo(m, state, trn, vel, i, ctrl, &out.act_dot);
            out.actuator_force[first..first + 3].copy_from_slice(&force);
        } else {
            let (length, velocity) = (trn.actuator_length[first], vel.actuator_velocity[first]);
            let act = &state.act;
            out.actuator_force[first] = match GainType::from_code(m.actuator_gaintype[i]) {
                Some(GainType::Dcmotor) => {
                    dc_motor::electrical_force(m, act, i, (length, velocity), ctrl, &out.act_dot)
                }
                Some(GainType::Pid) => {
                    let force = servo::pid_force(m, act, i, length, ctrl, &out.act_dot);
                    force + bias(m, i, length, velocity, user)
                }
                _ => {
                    let input = input(m, state, i, length, ctrl, &out.act_dot);
                    gain(m, i, length, velocity, user) * input + bias(m, i, length, velocity, user)
                }
            };
        }
    }
    if m.nplugin > 0 {
        for (_, running) in m.plugins().with(Capability::Actuator) {
            running.instance.forces(inputs, &out.act_dot, &mut out.actuator_force);
        }
    }
    limit_tendon_forces(m, &mut out.actuator_force);
    limit_forces(m, &mut out.actuator_force);
    for i in (0..m.nactuator).filter(|&i| m.actuator_biastype[i] == BiasType::Dcmotor.code() && works(i)) {
        let first = m.actuator_outadr[i] as usize;
        let length = trn.actuator_length[first];
        let force = &mut out.actuator_force[first];
        dc_motor::add_mechanical_force(m, &state.act, i, length, &out.act_dot, force);
    }
    for row in 0..m.nout {
        let force = out.actuator_force[row];
        if force != 0.0 {
            moment(trn, row).for_each(|(dof, arm)| out.qfrc_actuator[dof] += arm * force);
        }
    }
    limit_joint_forces(m, passive, &mut out.qfrc_actuator);
}

/// Control `k`, delayed if its actuator is, within its range.
#[inline(always)]
fn clamped_control(m: &Model, state: &State, k: usize) -> f64 {
    let u = match m.nhistory {
        0 => state.ctrl[k],
        _ => history::control(m, &state.history, &state.ctrl, state.time, k),
    };
    let clamps = !m.opt.disableflags.contains(Disable::CLAMPCTRL) && m.actuator_ctrllimited[k];
    if clamps { clip(u, m.actuator_ctrlrange[k]) } else { u }
}

/// What the gain multiplies: the last activation, after the step if the actuator acts early, or the control.
fn input(
    m: &Model,
    state: &State,
    i: usize,
    length: f64,
    ctrl: impl Fn(usize) -> f64,
    act_dot: &[f64],
) -> f64 {
    let u = match activations(m, i).last() {
        Some(k) if m.actuator_actearly[i] => next_activation(m, i, k, &state.act, act_dot[k], 0.0),
        Some(k) => state.act[k],
        None if m.actuator_ctrlnum[i] == 0 => 0.0,
        None => ctrl(m.actuator_ctrladr[i] as usize),
    };
    setpoint_period(m, i).map_or(u, |period| nearest_setpoint(u, length, period))
}

pub(crate) fn muscle<'a>(m: &Model, i: usize, prm: &'a [f64; 10]) -> Muscle<'a> {
    let out = m.actuator_outadr[i] as usize;
    Muscle { lengthrange: m.actuator_lengthrange[out], acc0: m.actuator_acc0[out], prm }
}

fn gain(m: &Model, i: usize, length: f64, velocity: f64, user: &impl UserActuators) -> f64 {
    let prm = &m.actuator_gainprm[i];
    match GainType::from_code(m.actuator_gaintype[i]) {
        Some(GainType::Fixed) => prm[0],
        Some(GainType::Affine) => prm[0] + prm[1] * length + prm[2] * velocity,
        Some(GainType::Muscle) => muscle(m, i, prm).gain(length, velocity),
        Some(GainType::User) => user.gain(i),
        // These have forces of their own or are refused by `validity::check_model`.
        Some(GainType::Dcmotor | GainType::So3 | GainType::Pid) | None => 0.0,
    }
}

#[inline]
fn bias(m: &Model, i: usize, length: f64, velocity: f64, user: &impl UserActuators) -> f64 {
    let prm = &m.actuator_biasprm[i];
    match BiasType::from_code(m.actuator_biastype[i]) {
        Some(BiasType::Affine) => prm[0] + prm[1] * length + prm[2] * velocity,
        Some(BiasType::Muscle) => muscle(m, i, prm).bias(length),
        Some(BiasType::User) => user.bias(i),
        Some(BiasType::None | BiasType::Dcmotor | BiasType::So3) | None => 0.0,
    }
}

/// Torque of a servo on orientation, along the shortest rotation to the target.
///
/// Not inlined, so that the addresses of its arrays are loaded only where such an actuator exists.
#[inline(never)]
fn orientation_servo(
    m: &Model,
    state: &State,
    trn: &Transmission,
    vel: &Velocity,
    i: usize,
    ctrl: impl Fn(usize) -> f64,
    act_dot: &[f64],
) -> Vec3 {
    let (u, a, out) =
        (m.actuator_ctrladr[i] as usize, activations(m, i).start, m.actuator_outadr[i] as usize);
    let target = if m.actuator_ctrlspec[i] == input::QUATERNION {
        quat_normalize(std::array::from_fn(|k| ctrl(u + k)))
    } else if m.actuator_dyntype[i] == DynType::None.code() {
        quat_from_vector(std::array::from_fn(|k| ctrl(u + k)))
    } else if m.actuator_actearly[i] {
        quat_from_vector(std::array::from_fn(|k| {
            next_activation(m, i, a + k, &state.act, act_dot[a + k], 0.0)
        }))
    } else {
        quat_from_vector(std::array::from_fn(|k| state.act[a + k]))
    };
    let now = quat_from_vector(std::array::from_fn(|k| trn.actuator_length[out + k]));
    let error = quat_difference(target, now);
    let (kp, prm) = (m.actuator_gainprm[i][0], &m.actuator_biasprm[i]);
    std::array::from_fn(|k| kp * error[k] + prm[0] + prm[2] * vel.actuator_velocity[out + k])
}

/// Quaternion of rotation vector `v`.
fn quat_from_vector(v: Vec3) -> Quat {
    let angle = norm(v);
    if angle < MINVAL { IDENTITY } else { quat_from_axis_angle(v.map(|x| x / angle), angle) }
}

/// Scales the forces of all actuators on a tendon so that their sum stays in the tendon's range.
fn limit_tendon_forces(m: &Model, force: &mut [f64]) {
    let on_tendon = |t: usize| {
        (0..m.nactuator)
            .filter(move |&i| {
                m.actuator_trntype[i] == TrnType::Tendon.code() && m.actuator_trnid[i][0] as usize == t
            })
            .map(|i| m.actuator_outadr[i] as usize)
    };
    for t in (0..m.ntendon).filter(|&t| m.tendon_actfrclimited[t]) {
        let total = on_tendon(t).fold(0.0, |sum, out| sum + force[out]);
        let [low, high] = m.tendon_actfrcrange[t];
        let limit = clip(total, [low, high]);
        if total != 0.0 && limit != total {
            on_tendon(t).for_each(|out| force[out] *= limit / total);
        }
    }
}

/// Limits each output to the actuator's range; of an orientation servo, the norm.
fn limit_forces(m: &Model, force: &mut [f64]) {
    for i in (0..m.nactuator).filter(|&i| m.actuator_forcelimited[i]) {
        let first = m.actuator_outadr[i] as usize;
        let range = m.actuator_forcerange[i];
        let outputs = &mut force[first..first + m.actuator_outnum[i] as usize];
        if m.actuator_gaintype[i] == GainType::So3.code() {
            let torque = [outputs[0], outputs[1], outputs[2]];
            let size = norm(torque);
            if size > range[1] {
                outputs.copy_from_slice(&scale(torque, range[1] / size));
            }
        } else {
            outputs.iter_mut().for_each(|f| *f = clip(*f, range));
        }
    }
}

/// Adds the gravity compensation that actuators provide, then limits the force on each joint.
fn limit_joint_forces(m: &Model, passive: &Passive, qfrc: &mut [f64]) {
    let compensates = has_gravity_compensation(m);
    for j in 0..m.njnt {
        let first = m.jnt_dofadr[j] as usize;
        if compensates && m.jnt_actgravcomp[j] {
            let dofs = match JointType::from_code(m.jnt_type[j]) {
                Some(JointType::Free) => 6,
                Some(JointType::Ball) => 3,
                Some(JointType::Slide | JointType::Hinge) | None => 1,
            };
            (first..first + dofs).for_each(|dof| qfrc[dof] += passive.qfrc_gravcomp[dof]);
        }
        if m.jnt_actfrclimited[j] {
            qfrc[first] = clip(qfrc[first], m.jnt_actfrcrange[j]);
        }
    }
}
