//! A stand-in for MuJoCo's Python bindings: models and simulations with MuJoCo's names, on this engine.
//!
//! | file | what |
//! |---|---|
//! | `arena.rs`, `mirror.rs`, `fresh.rs` | numpy arrays beside the engine's, copied around every call; fresh ones |
//! | `model.rs`, `load.rs` | models, their options, where they come from |
//! | `data.rs`, `lists.rs`, `lent.rs` | simulations, arrays that change length, and what is written into these |
//! | `warned.rs`, `timed.rs`, `saved.rs` | warnings, timers, states as vectors |
//! | `statistics.rs` | what of these and of the solver is kept in pickles |
//! | `call.rs`, `error.rs` | what every call does, and how it fails |
//! | `dynamics.rs`, `stages.rs`, `rollout.rs` | steps and passes, their parts, trajectories on threads |
//! | `asked.rs` | stages in parts, between which callbacks are asked |
//! | `query.rs`, `algebra.rs`, `quaternion.rs` | questions about poses, matrices, rotations |
//! | `pictures/` | pictures, and the items of a scene |
//! | `spec/` | descriptions of models: read, compiled, written |
//!
//! Functions with MuJoCo's signatures that write into arrays of the caller are Python (`robohive/mujoco`); here is what
//! they call, which returns fresh values.

mod algebra;
mod arena;
mod asked;
mod call;
mod data;
mod dynamics;
mod error;
mod fresh;
mod lent;
mod lists;
mod load;
mod mirror;
mod model;
mod pictures;
mod quaternion;
mod query;
mod rollout;
mod saved;
mod spec;
mod stages;
mod statistics;
mod timed;
mod warned;

pub use data::Data;
pub use model::Model;
pub use pictures::{Free, Guest};

use pyo3::pymodule;

/// Models and simulations with MuJoCo's names.
#[pymodule(name = "mujoco", submodule)]
pub mod bindings {
    #[pymodule_export]
    use super::algebra::{
        difference, full_matrix, inverse_slopes, moved, mul_inertia, solve_inertia, step_slopes,
    };
    #[pymodule_export]
    use super::asked::{actuator_forces, actuator_rates, collide_known};
    #[pymodule_export]
    use super::data::{Data, data_fields};
    #[pymodule_export]
    use super::dynamics::{
        mj_forward, mj_forward_skip, mj_inverse, mj_reset_data, mj_reset_data_keyframe, mj_step, mj_step1,
        mj_step2, resets, set_called, set_resets,
    };
    #[pymodule_export]
    use super::error::{FatalError, UnexpectedError};
    #[pymodule_export]
    use super::lists::{constraints, contacts, dense_jacobian, make_islands, make_rows, set_contacts};
    #[pymodule_export]
    use super::load::{dependencies, load_path, load_text, schema};
    #[pymodule_export]
    use super::model::{CompiledModel, Model, default_settings, model_fields};
    #[pymodule_export]
    use super::pictures::painter::{Painter, letter_rows};
    #[pymodule_export]
    use super::quaternion::{
        conjugate, eigen, integrate, matrix, multiply, multiply_axis, normalise, of_axis_angle, rotate,
        subtract, velocity,
    };
    #[pymodule_export]
    use super::query::{
        axis_rates, cast_at_geom, cast_at_shape, cast_ray, cast_rays, contact_force, geom_distance, jacobian,
        joint_forces, muscle_forces, muscle_rate, object_motion, recall, solver,
    };
    #[pymodule_export]
    use super::rollout::roll_out;
    #[pymodule_export]
    use super::saved::{get_state, set_state, state_size};
    #[pymodule_export]
    use super::spec::{Description, actuator_shortcut, orientation, spec_forms};
    #[pymodule_export]
    use super::stages::{forces_at, inverse_skip, newton_euler, stage};
}
