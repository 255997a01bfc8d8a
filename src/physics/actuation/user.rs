//! Actuators of a program's own: gain, bias and dynamics of type `user` (documentation: XML Reference, "actuator/general").
//!
//! Without a program they are what MuJoCo takes where no callback is set: gain 1, bias 0, activations at rest. A program
//! that knows better asks [`asked`] which actuators want what, and computes actuation in two halves:
//! [`rates`](super::rates), after which it sets rates of activation, and [`forces`](super::forces) with its gains and biases.
//!
//! ```
//! use robohive_physics::actuation::user::{Given, asked};
//! use robohive_physics::actuation::{forces, rates};
//! use robohive_physics::{Data, forward, model::ActuatorInputs};
//!
//! let m = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody><actuator><general joint='j' gaintype='user'/></actuator></mujoco>",
//! )?
//! .model;
//! let mut d = Data::new(&m);
//! d.state.ctrl[0] = 0.5;
//! forward(&m, &mut d)?;
//! assert_eq!((asked(&m, &d.state).gain, d.actuation.actuator_force[0]), (vec![0], 0.5));
//!
//! let inputs = ActuatorInputs { m: &m, state: &d.state, trn: &d.trn, vel: &d.vel };
//! rates(&inputs, &mut d.actuation);
//! forces(&inputs, &Given { gain: vec![6.0], bias: vec![0.0] }, &d.passive, &mut d.actuation);
//! assert_eq!(d.actuation.actuator_force[0], 3.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::actuation::setpoint::{activations, is_disabled};
use crate::model::{BiasType, DynType, GainType, Model};
use crate::sleep::{Awake, object};
use crate::stages::State;

/// Gains and biases of actuators whose type is `user`.
pub trait UserActuators {
    /// What the input of actuator `i` is multiplied by.
    fn gain(&self, i: usize) -> f64;

    /// What is added to the force of actuator `i` \[N, N m\].
    fn bias(&self, i: usize) -> f64;
}

/// No program: the input passes through.
#[derive(Clone, Copy, Debug)]
pub struct Unset;

impl UserActuators for Unset {
    #[inline(always)]
    fn gain(&self, _: usize) -> f64 {
        1.0
    }

    #[inline(always)]
    fn bias(&self, _: usize) -> f64 {
        0.0
    }
}

/// Numbers that a program has computed, one for each actuator of the model.
#[derive(Clone, Debug)]
pub struct Given {
    /// Gains; those of actuators whose gain is not of type `user` are not read.
    pub gain: Vec<f64>,
    /// Biases \[N, N m\], likewise.
    pub bias: Vec<f64>,
}

impl UserActuators for Given {
    fn gain(&self, i: usize) -> f64 {
        self.gain[i]
    }

    fn bias(&self, i: usize) -> f64 {
        self.bias[i]
    }
}

/// Actuators that a program may compute something of, in ascending order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// Rates of activation: those with activations whose dynamics are of type `user`.
    pub dynamics: Vec<usize>,
    /// Gains.
    pub gain: Vec<usize>,
    /// Biases.
    pub bias: Vec<usize>,
}

/// The actuators of type `user` that act in this state: not those that sleep, nor, of gains and biases, disabled ones and
/// those of plugins.
pub fn asked(m: &Model, state: &State) -> Asked {
    let awake = Awake::of(m, state);
    let mut asked = Asked::default();
    for i in (0..m.nactuator).filter(|&i| !awake.skips(|state| object::actuator(m, state, i))) {
        if m.actuator_dyntype[i] == DynType::User.code() && !activations(m, i).is_empty() {
            asked.dynamics.push(i);
        }
        if is_disabled(m, i) || m.nplugin > 0 && m.actuator_plugin[i] >= 0 {
            continue;
        }
        if m.actuator_gaintype[i] == GainType::User.code() {
            asked.gain.push(i);
        }
        if m.actuator_biastype[i] == BiasType::User.code() {
            asked.bias.push(i);
        }
    }
    asked
}
