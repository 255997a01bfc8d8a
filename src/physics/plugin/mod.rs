//! Plugins: forces, actuators, sensors and signed distance fields that a model names and a program provides
//! (documentation: Programming, "Extensions").
//!
//! A [`Plugin`] is a kind: its name, the attributes that it takes, and what it can do. A model declares instances of it,
//! and each becomes an [`Instance`] once the model is compiled, which computes from the model and the state alone.
//! What changes from step to step is in [`State::plugin_state`](crate::stages::State::plugin_state), so that copies of
//! `Data` and saved states are whole.
//!
//! MuJoCo's own are always there: `mujoco.pid`, `mujoco.elasticity.cable`, `mujoco.sensor.touch_grid` and the fields
//! `mujoco.sdf.bolt`, `bowl`, `gear`, `nut` and `torus`. Others are added to a [`Registry`], which the loader of models
//! takes.
//!
//! ```
//! use robohive_physics::plugin::{AttributeError, Capability, Config, Instance, PassiveInputs, Plugin, Registry};
//! use robohive_physics::{Data, Model, step};
//!
//! /// Pushes every degree of freedom of the model with one force.
//! #[derive(Debug)]
//! struct Push(f64);
//!
//! #[derive(Debug)]
//! struct PushKind;
//!
//! impl Plugin for PushKind {
//!     fn name(&self) -> &str {
//!         "example.push"
//!     }
//!     fn attributes(&self) -> &[&str] {
//!         &["force"]
//!     }
//!     fn capabilities(&self) -> &[Capability] {
//!         &[Capability::Passive]
//!     }
//!     fn instance(&self, config: &Config, _: &Model, _: usize) -> Result<Box<dyn Instance>, AttributeError> {
//!         Ok(Box::new(Push(config.number("force")?.unwrap_or(1.0))))
//!     }
//! }
//!
//! impl Instance for Push {
//!     fn passive(&self, _: &PassiveInputs, qfrc: &mut [f64]) {
//!         qfrc.iter_mut().for_each(|f| *f += self.0);
//!     }
//! }
//!
//! let mut registry = Registry::default();
//! registry.register(PushKind)?;
//! let text = "<mujoco><extension><plugin plugin='example.push'><instance name='p'><config key='force' value='3'/></instance></plugin></extension><worldbody><body><plugin instance='p'/><joint type='slide'/><geom size='.1' mass='2'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::Loader::default().plugins(registry).load_str(text)?.model;
//! let mut data = Data::new(&model);
//! step(&model, &mut data)?;
//! assert_eq!(data.passive.qfrc_passive[0], 3.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cable;
mod instances;
mod pid;
mod registry;
mod sdf;
mod touch_grid;

pub use config::{AttributeError, Config};
pub(crate) use instances::Instances;
pub use instances::PluginError;
pub use registry::{Registry, RegistryError};
pub use sdf::Field;

pub use crate::sensor::{AccelerationInputs, PositionInputs, VelocityInputs};

use crate::data::{Configuration, Contacts, State, Transmission, Velocity};
use crate::model::{Model, Stage};
use std::fmt::Debug;

/// What a plugin can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Capability {
    /// Forces of actuators.
    Actuator,
    /// Readings of sensors.
    Sensor,
    /// Passive forces.
    Passive,
    /// Signed distances of geoms.
    Sdf,
}

/// A kind of plugin.
pub trait Plugin: Debug + Send + Sync {
    /// Its name, which models use; distinct from all others.
    fn name(&self) -> &str;

    /// Names of the attributes that an instance may set; a model that sets another is refused.
    fn attributes(&self) -> &[&str];

    /// What it can be asked for; a model that asks for something else is refused.
    fn capabilities(&self) -> &[Capability];

    /// When its sensors can be read: after positions, velocities or accelerations.
    fn stage(&self) -> Stage {
        Stage::Acc
    }

    /// How many numbers an instance keeps in [`State::plugin_state`](crate::data::State::plugin_state).
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn states(&self, _config: &Config) -> Result<usize, AttributeError> {
        Ok(0)
    }

    /// How many numbers a sensor of an instance reads.
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn readings(&self, _config: &Config) -> Result<usize, AttributeError> {
        Ok(0)
    }

    /// The field of an instance with capability [`Sdf`](Capability::Sdf), in its own frame [m].
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn field(&self, _config: &Config) -> Result<Option<Box<dyn Field>>, AttributeError> {
        Ok(None)
    }

    /// Makes instance `id` of a compiled model.
    ///
    /// # Errors
    /// What is wrong with the attributes, or with the elements that use the instance.
    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError>;
}

/// What a passive force may depend on.
#[derive(Clone, Copy, Debug)]
pub struct PassiveInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// State, poses, centres of mass and tendon paths.
    pub at: Configuration<'a>,
    /// Contacts.
    pub con: &'a Contacts,
    /// Velocities of tendons, actuators and bodies.
    pub vel: &'a Velocity,
}

/// What the force of an actuator may depend on.
#[derive(Clone, Copy, Debug)]
pub struct ActuatorInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// State and controls, which are neither delayed nor limited to their ranges.
    pub state: &'a State,
    /// Lengths and moment arms.
    pub trn: &'a Transmission,
    /// Velocities of actuators.
    pub vel: &'a Velocity,
}

/// What a sensor may read, by the stage of its plugin.
#[derive(Clone, Copy, Debug)]
pub enum SensorInputs<'a> {
    /// All that depends on positions.
    Position(&'a PositionInputs<'a>),
    /// All that depends on positions and velocities.
    Velocity(&'a VelocityInputs<'a>),
    /// All that a step computes.
    Acceleration(&'a AccelerationInputs<'a>),
}

/// A plugin at work in one model. It may keep what follows from the model, and nothing that a step changes.
pub trait Instance: Debug + Send + Sync {
    /// Sets the state of the instance, which is zero, at a reset of the simulation.
    fn reset(&self, _m: &Model, _state: &mut [f64]) {}

    /// Adds its forces to `qfrc`, one number a degree of freedom [N, N m].
    fn passive(&self, _inputs: &PassiveInputs, _qfrc: &mut [f64]) {}

    /// Sets the rates of the activations of its actuators in `act_dot`; those of built-in dynamics are there.
    fn activation_rates(&self, _inputs: &ActuatorInputs, _act_dot: &mut [f64]) {}

    /// Sets the forces of its actuators in `force`, one number an output, before ranges limit them [N, N m].
    fn forces(&self, _inputs: &ActuatorInputs, _act_dot: &[f64], _force: &mut [f64]) {}

    /// Reads sensor `sensor` of the model into `out`, which is zero.
    fn read(&self, _m: &Model, _inputs: &SensorInputs, _sensor: usize, _out: &mut [f64]) {}

    /// Moves the state of the instance, `own`, over a time step. The rest of the state is that after the step, without
    /// `plugin_state`.
    fn advance(&self, _m: &Model, _state: &State, _own: &mut [f64]) {}

    /// Its signed distance field.
    fn field(&self) -> Option<&dyn Field> {
        None
    }
}
