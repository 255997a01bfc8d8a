//! Physics that follows MuJoCo 3.12: a constant [`Model`], a changing [`Data`], and the stages of a step between them.
//!
//! Programs that depend on the crate `robohive` reach this one as `robohive::physics`.
//!
//! # Conventions
//! - SI units; world z up; angles in radians; quaternions w-x-y-z; matrices row-major.
//! - Spatial vectors are rotation first. "Com-based" means expressed in the world orientation about the centre of
//!   mass of the kinematic tree.
//! - Arrays have MuJoCo's names. Indices are `usize` in code; stored references are `i32`, -1 for none.
//! - A stage takes the model, the stage structs it reads, and `&mut` the one it writes.
//! - Elements are found by name and viewed by id, see [`elements`].
//! - The numbers of a model change through [`Model::edit`], which derives what follows from them, through
//!   [`Model::overwrite`], which derives nothing, and, options alone, through [`Model::options_mut`].
//! - The same bits everywhere: transcendental functions come from [`math::ops`], sums have a fixed order, and no
//!   multiply-add is fused.
//!
//! ```
//! use robohive_physics::{Data, step};
//!
//! let text = "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! (0..100).try_for_each(|_| step(&model, &mut data))?;
//! let ball = model.body("ball").ok_or("no ball")?;
//! assert!(data.body(ball).xpos()[2] < -0.19);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrays;
pub mod batch;
pub mod binary;
mod caches;
pub mod collision;
pub mod consistency;
pub mod constants;
pub mod data;
pub mod derivative;
mod edit;
pub mod elements;
pub mod geometry;
pub mod inertia;
pub mod integration;
pub mod math;
pub mod model;
pub mod pipeline;
pub mod plugin;
pub mod position;
pub mod ray;
mod sleep;
mod stages;
pub mod table;

// Stages of a step, one at a time: what validation and tests call, and programs do not need.
#[doc(hidden)]
pub mod acceleration;
#[doc(hidden)]
pub mod actuation;
#[doc(hidden)]
pub mod constraint;
#[doc(hidden)]
pub mod flex;
#[doc(hidden)]
pub mod on_demand;
#[doc(hidden)]
pub mod sensor;
#[doc(hidden)]
pub mod solver;
#[doc(hidden)]
pub mod velocity;

pub use batch::{Batch, BatchError, Environment};
pub use constants::length_range::set_length_ranges;
pub use constants::set_const::set_const;
pub use data::{Data, Snapshot};
pub use model::Model;
pub use pipeline::error::StepError;
pub use pipeline::forward::{forward, forward_after_step1};
pub use pipeline::inverse::inverse;
pub use pipeline::on_demand::{derive_body_forces, derive_on_demand};
pub use pipeline::step::{step, step_watched, step1, step2};
pub use pipeline::stepper::{Engine, Memory, Mover, Stepper};
