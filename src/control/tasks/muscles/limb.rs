//! A limb whose joints are driven to wanted angles by actuators that pull: joints accelerate as springs with dampers, by torques that
//! static optimisation shares among the actuators, whose activations lag behind their controls.

use crate::controller::command;
use crate::error::ControlError;
use crate::maths::activations;
use env::Env;
use env::suite::muscle::{Condition, TRANSFER, normalized};
use nalgebra::{DMatrix, DVector};
use physics::Model;
use physics::actuation::muscle::Muscle;
use physics::actuation::transmission::moment;
use physics::inertia::full_inertia;
use physics::model::{BiasType, GainType};

/// Acceleration by angle \[1/s²\], by speed \[1/s\], and by what the angle lacked so far \[1/s³\]: slow beside the lag of muscles.
const STIFFNESS: f64 = 80.0;
const DAMPING: f64 = 16.0;
const PATIENCE: f64 = 120.0;
/// Largest sum of what angles lacked \[rad s\].
const MOST: f64 = 0.5;
/// Error below which an angle lacks something \[rad\].
const NEAR: f64 = 0.2;
/// How much further controls go than the activations that they are to bring, against the lag.
const LEAD: f64 = 1.0;

/// A limb in an environment.
pub struct Limb {
    /// What each angle lacked so far \[rad s\].
    lacked: Vec<f64>,
    controls: Vec<f64>,
    /// After a tendon transfer: the actuator whose action drives another, and the other.
    transfer: Option<[usize; 2]>,
}

/// What actuators do to joints: torques are `rest` and, for every actuator, its share of its largest control times `strength`.
struct Pulls {
    /// Joints by actuators.
    strength: DMatrix<f64>,
    rest: DVector<f64>,
    /// Bounds of the shares.
    bounds: Vec<[f64; 2]>,
}

impl Limb {
    /// The limb of an environment, all joints of which are hinges and slides.
    ///
    /// # Errors
    /// Joints of other types; actuators whose forces are not a gain times a control or activation, and a bias.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        if m.nq != m.nv {
            return Err(ControlError::unfit(env, "a limb has hinges and slides alone"));
        }
        if m.nu != m.nactuator {
            return Err(ControlError::unfit(env, "every actuator of a limb has one control"));
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
        let transfer = match env.spec().args.get("muscle_condition") {
            Some(Condition::Reafferentation) => {
                let [from, to] = TRANSFER.map(|name| env.scene().actuator(name));
                Some([from?.index(), to?.index()])
            }
            _ => None,
        };
        Ok(Limb { lacked: vec![0.0; m.nv], controls: vec![0.0; m.nu], transfer })
    }

    /// Forgets what angles lacked.
    pub fn restart(&mut self) {
        self.lacked.fill(0.0);
    }

    /// Writes the action that brings the joints by `errors` further (nv) \[rad, m\].
    ///
    /// # Errors
    /// Nothing pulls.
    pub fn act(&mut self, env: &Env, errors: &[f64], action: &mut [f64]) -> Result<(), ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        for (lacked, error) in self.lacked.iter_mut().zip(errors) {
            // What is far is on its way, and nothing is lacking yet.
            let near = if error.abs() < NEAR { *error } else { 0.0 };
            *lacked = (*lacked + near * env.dt()).clamp(-MOST, MOST);
        }
        let spring = |joint: usize| STIFFNESS * errors[joint] + PATIENCE * self.lacked[joint];
        let speed = &data.state.qvel;
        let asked = DVector::from_fn(m.nv, |joint, _| spring(joint) - DAMPING * speed[joint]);
        // Friction of joints is left to slow them down, as if it were the damper of a larger inertia.
        let apart = DVector::from_fn(m.nv, |joint, _| {
            let friction = m.dof_damping[joint];
            let (bias, passive) = (data.vel.qfrc_bias[joint], data.passive.qfrc_passive[joint]);
            bias - passive + friction * (spring(joint) / DAMPING - speed[joint])
        });
        let Pulls { mut strength, rest, mut bounds } = pulls(env);
        if let Some([from, _]) = self.transfer {
            bounds[from] = [0.0; 2];
        }
        let inertia = DMatrix::from_row_slice(m.nv, m.nv, &full_inertia(m, &data.inertia.M));
        let mut torques = inertia * asked + apart - rest;
        // Weak joints count as much as strong ones.
        for joint in 0..m.nv {
            let most = strength.row(joint).norm();
            if most > 0.0 {
                strength.row_mut(joint).unscale_mut(most);
                torques[joint] /= most;
            } else {
                torques[joint] = 0.0;
            }
        }
        let shares = activations(&strength, &torques, &bounds)?;
        for (actuator, control) in self.controls.iter_mut().enumerate() {
            let [low, high] = range(m, actuator);
            let wanted = shares[actuator] * most(m, actuator);
            let lag = activation(env, actuator).map_or(0.0, |now| wanted - now);
            *control = (wanted + LEAD * lag).clamp(low, high);
        }
        if m.na == 0 || !env.settings().normalize_act {
            return command(env, &self.controls, action);
        }
        for (actuator, value) in action.iter_mut().enumerate() {
            *value = normalized(m, actuator, self.controls[actuator]);
        }
        if let Some([from, to]) = self.transfer {
            action[from] = action[to];
        }
        Ok(())
    }
}

/// The activation of an actuator that has one.
fn activation(env: &Env, actuator: usize) -> Option<f64> {
    let place = usize::try_from(env.scene().model.actuator_actadr[actuator]).ok()?;
    Some(env.scene().data.state.act[place])
}

fn pulls(env: &Env) -> Pulls {
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
fn range(m: &Model, actuator: usize) -> [f64; 2] {
    if m.actuator_ctrllimited[actuator] { m.actuator_ctrlrange[actuator] } else { [-1.0, 1.0] }
}

/// Largest magnitude of a control.
fn most(m: &Model, actuator: usize) -> f64 {
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
