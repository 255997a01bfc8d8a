//! Physics that follows MuJoCo 3.12: a constant [`Model`], a changing [`Data`], and the stages of a step between them.
//!
//! # Conventions
//! - SI units; world z up; angles in radians; quaternions w-x-y-z; matrices row-major.
//! - Spatial vectors are rotation first. "Com-based" means expressed in the world orientation about the centre of
//!   mass of the kinematic tree.
//! - Arrays bear MuJoCo's names. Indices are `usize` in code; stored references are `i32`, -1 for none.
//! - A stage takes the model, the stage structs it reads, and `&mut` the one it writes.
//! - The same bits everywhere: transcendental functions come from [`math::ops`], sums have a fixed order, and no
//!   multiply-add is fused.

pub mod activation;
pub mod actuation;
pub mod batch;
pub mod bias;
pub mod camera;
pub mod chain;
pub mod collision;
pub mod com;
pub mod consistency;
pub mod constraint;
pub mod contact_force;
pub mod data;
pub mod dc_motor;
pub mod derivative;
pub mod energy;
pub mod fluid;
pub mod forward;
pub mod frame;
pub mod history;
pub mod implicit;
pub mod inertia;
pub mod integrate;
pub mod inverse;
mod inverse_weight;
pub mod jacobian;
pub mod kinematics;
pub mod length_range;
pub mod math;
pub mod model;
pub mod momentum;
pub mod muscle;
pub mod on_demand;
pub mod passive;
pub mod polynomial;
pub mod ray;
pub mod reflected_load;
pub mod rne_post;
pub mod sensor;
pub mod servo;
pub mod set_const;
pub mod solver;
pub mod sparsity;
pub mod statistic;
pub mod table;
pub mod tendon;
pub mod transition;
pub mod transmission;
pub mod validity;
pub mod velocity;
pub mod watch;
pub mod wrap;

pub use batch::{Batch, BatchError};
pub use data::Data;
pub use forward::{StepError, forward, step, step_watched, step1, step2};
pub use inverse::inverse;
pub use length_range::set_length_ranges;
pub use model::Model;
pub use on_demand::derive_on_demand;
pub use set_const::set_const;
