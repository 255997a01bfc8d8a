//! A limb whose joints are driven to wanted angles by actuators that pull: joints accelerate as springs with dampers, by torques that
//! static optimisation shares among the actuators, whose activations lag behind their controls.

use super::pulls::{Pulls, activation, check, even, most, pulls, range};
use crate::controller::command;
use crate::error::ControlError;
use crate::maths::activations;
use env::Env;
use env::suite::muscle::{Condition, TRANSFER, normalized};
use nalgebra::{DMatrix, DVector};
use physics::inertia::full_inertia;

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
        check(env)?;
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
        even(&mut strength, &mut torques);
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
