//! Slope of actuator forces over velocity. Forces at their limit do not move and have none; the limits of tendons and
//! joints are not seen (MuJoCo documentation, Computation, "Numerical integration").

use super::inputs::{DerivativeInputs, add_square};
use crate::actuation::activation::next_activation;
use crate::actuation::dc_motor;
use crate::actuation::muscle;
use crate::actuation::setpoint::{activations, is_disabled};
use crate::math::norm;
use crate::model::{BiasType, Disable, DynType, GainType, Model};

/// Adds `d qfrc_actuator / d qvel`.
pub(super) fn add_actuators(m: &Model, inputs: &DerivativeInputs, out: &mut [f64]) {
    if m.opt.disableflags.contains(Disable::ACTUATION) {
        return;
    }
    let trn = inputs.trn;
    for i in (0..m.nactuator).filter(|&i| !is_disabled(m, i)) {
        let first = m.actuator_outadr[i] as usize;
        if is_saturated(m, i, &inputs.actuation.actuator_force[first..]) {
            continue;
        }
        let slope = slope(m, inputs, i);
        if slope == 0.0 {
            continue;
        }
        for output in first..first + m.actuator_outnum[i] as usize {
            let start = trn.moment_rowadr[output] as usize;
            let at = start..start + trn.moment_rownnz[output] as usize;
            add_square(m, &trn.moment_colind[at.clone()], &trn.actuator_moment[at], slope, out);
        }
    }
}

/// True when the force is at the actuator's limit; of an orientation servo, the norm.
fn is_saturated(m: &Model, i: usize, force: &[f64]) -> bool {
    let [low, high] = m.actuator_forcerange[i];
    m.actuator_forcelimited[i]
        && if m.actuator_gaintype[i] == GainType::So3.code() {
            norm([force[0], force[1], force[2]]) >= high
        } else {
            force[0] <= low || force[0] >= high
        }
}

/// Derivative of the force `gain * input + bias` with respect to the actuator's velocity.
fn slope(m: &Model, inputs: &DerivativeInputs, i: usize) -> f64 {
    let out = m.actuator_outadr[i] as usize;
    let bias = match BiasType::from_code(m.actuator_biastype[i]) {
        Some(BiasType::Affine | BiasType::So3) => m.actuator_biasprm[i][2],
        Some(BiasType::Dcmotor) => dc_motor::slope(m, i),
        // Refused by `validity::check_model`, or independent of velocity.
        Some(BiasType::None | BiasType::Muscle | BiasType::User) | None => 0.0,
    };
    let prm = &m.actuator_gainprm[i];
    let gain =
        match GainType::from_code(m.actuator_gaintype[i]) {
            Some(GainType::Affine) => prm[2],
            Some(GainType::Muscle) => muscle(m, i, prm)
                .gain_slope(inputs.trn.actuator_length[out], inputs.vel.actuator_velocity[out]),
            Some(GainType::Fixed | GainType::Dcmotor | GainType::So3 | GainType::Pid | GainType::User)
            | None => 0.0,
        };
    if gain == 0.0 { bias } else { bias + gain * input(m, inputs, i) }
}

/// What the gain multiplies. A control counts as given, not clamped to its range.
fn input(m: &Model, inputs: &DerivativeInputs, i: usize) -> f64 {
    let state = inputs.state;
    match activations(m, i).last() {
        Some(k) if m.actuator_dyntype[i] != DynType::None.code() => {
            if m.actuator_actearly[i] {
                next_activation(m, i, k, &state.act, inputs.actuation.act_dot[k], 0.0)
            } else {
                state.act[k]
            }
        }
        _ if m.actuator_ctrlnum[i] == 0 => 0.0,
        _ => state.ctrl[m.actuator_ctrladr[i] as usize],
    }
}
