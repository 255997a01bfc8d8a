//! What actuators that pull do to joints: muscles, and motors whose forces are a gain times a control or activation, and a bias.

use crate::error::ControlError;
use env::Env;
use nalgebra::{DMatrix, DVector};
use physics::Model;
use physics::actuation::muscle::Muscle;
use physics::actuation::transmission::moment;
use physics::model::{BiasType, GainType};

/// What actuators do to joints: torques are `rest` and, for every actuator, its share of its largest control times `strength`.
pub struct Pulls {
    /// Joints by actuators.
    pub strength: DMatrix<f64>,
    /// Torques of actuators that rest.
    pub rest: DVector<f64>,
    /// Bounds of the shares.
    pub bounds: Vec<[f64; 2]>,
}

/// Refuses a body some of whose actuators are neither.
///
/// # Errors
/// Actuators of other kinds, or with several controls.
pub fn check(env: &Env) -> Result<(), ControlError> {
    let m = &env.scene().model;
    if m.nu != m.nactuator {
        return Err(ControlError::unfit(env, "every actuator that pulls has one control"));
    }
    for actuator in 0..m.nu {
        let gain = GainType::from_code(m.actuator_gaintype[actuator]);
        let bias = BiasType::from_code(m.actuator_biastype[actuator]);
        let known = matches!(gain, Some(GainType::Fixed | GainType::Affine | GainType::Muscle))
            && matches!(bias, Some(BiasType::None | BiasType::Affine | BiasType::Muscle));
        if !(known && most(m, actuator) > 0.0) {
            return Err(ControlError::unfit(
                env,
                format!("actuator {actuator} is neither a muscle nor a motor"),
            ));
        }
    }
    Ok(())
}

/// Scales rows of strengths, and their torques, to length one: weak joints count as much as strong ones. Where nothing pulls, no torque
/// is asked for.
pub fn even(strength: &mut DMatrix<f64>, torques: &mut DVector<f64>) {
    for joint in 0..strength.nrows() {
        let most = strength.row(joint).norm();
        if most > 0.0 {
            strength.row_mut(joint).unscale_mut(most);
            torques[joint] /= most;
        } else {
            torques[joint] = 0.0;
        }
    }
}

/// The activation of an actuator that has one.
pub fn activation(env: &Env, actuator: usize) -> Option<f64> {
    let place = usize::try_from(env.scene().model.actuator_actadr[actuator]).ok()?;
    Some(env.scene().data.state.act[place])
}

/// What the actuators of an environment do to its joints as they are.
pub fn pulls(env: &Env) -> Pulls {
    let (m, data) = (&env.scene().model, &env.scene().data);
    let (mut strength, mut rest) = (DMatrix::zeros(m.nv, m.nu), DVector::zeros(m.nv));
    for actuator in 0..m.nu {
        let out = m.actuator_outadr[actuator] as usize;
        let (length, velocity) = (data.trn.actuator_length[out], data.vel.actuator_velocity[out]);
        let [gain, bias] = forces(m, actuator, length, velocity);
        for (joint, arm) in moment(&data.trn, out) {
            strength[(joint, actuator)] = arm * gain * most(m, actuator);
            rest[joint] += arm * bias;
        }
    }
    let bounds = (0..m.nu).map(|actuator| range(m, actuator).map(|end| end / most(m, actuator)));
    Pulls { strength, rest, bounds: bounds.collect() }
}

/// Range of a control; without one, that of a normalised action.
pub fn range(m: &Model, actuator: usize) -> [f64; 2] {
    if m.actuator_ctrllimited[actuator] { m.actuator_ctrlrange[actuator] } else { [-1.0, 1.0] }
}

/// Largest magnitude of a control.
pub fn most(m: &Model, actuator: usize) -> f64 {
    let [low, high] = range(m, actuator);
    low.abs().max(high.abs())
}

/// Force of an actuator for a unit of its control or activation, and without any \[N, N m\].
fn forces(m: &Model, actuator: usize, length: f64, velocity: f64) -> [f64; 2] {
    let out = m.actuator_outadr[actuator] as usize;
    let (gain, bias) = (&m.actuator_gainprm[actuator], &m.actuator_biasprm[actuator]);
    let muscle = |prm| Muscle { lengthrange: m.actuator_lengthrange[out], acc0: m.actuator_acc0[out], prm };
    let affine = |prm: &[f64; 10]| prm[0] + prm[1] * length + prm[2] * velocity;
    [
        match GainType::from_code(m.actuator_gaintype[actuator]) {
            Some(GainType::Muscle) => muscle(gain).gain(length, velocity),
            Some(GainType::Affine) => affine(gain),
            _ => gain[0],
        },
        match BiasType::from_code(m.actuator_biastype[actuator]) {
            Some(BiasType::Muscle) => muscle(bias).bias(length),
            Some(BiasType::Affine) => affine(bias),
            _ => 0.0,
        },
    ]
}
