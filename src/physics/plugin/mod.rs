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
//! [`Instance::appearance`] changes pictures: it colours geoms and adds shapes, an [`Appearance`], as callbacks for visualisation
//! do in MuJoCo. Nothing is written into the model.
//!
//! ```
//! use robohive_physics::plugin::{Appearance, AppearanceInputs, AttributeError, Capability, Config};
//! use robohive_physics::plugin::{Instance, PassiveInputs, Plugin, Registry};
//! use robohive_physics::pipeline::appearance::appearance;
//! use robohive_physics::{Data, Model, step};
//!
//! /// Pushes every degree of freedom of the model with one force, and shows the first geom redder the stronger it is.
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
//!     fn appearance(&self, _: &AppearanceInputs, out: &mut Appearance) {
//!         out.colour_geom(0, [self.0 as f32 / 4.0, 0.0, 0.0, 1.0]);
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
//! let mut seen = Appearance::default();
//! appearance(&model, &data, &mut seen);
//! assert_eq!(seen.colour_of(0), Some([0.75, 0.0, 0.0, 1.0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cable;
mod instances;
mod pid;
mod registry;
mod sdf;
mod touch_grid;

pub use crate::model::{
    ActuatorInputs, Appearance, AppearanceInputs, AttributeError, Capability, Config, Field, Instance, Mark,
    PassiveInputs, Plugin, PluginError, Registry, RegistryError, SensorInputs,
};
pub use crate::stages::{AccelerationInputs, PositionInputs, VelocityInputs};
