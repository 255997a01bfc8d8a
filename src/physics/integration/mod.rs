//! The time step itself: from accelerations to the next state.
//!
//! ```
//! use robohive_physics::model::Integrator;
//! use robohive_physics::{Data, step};
//!
//! let mut model = robohive_mjcf::load_str("<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>")?.model;
//! model.options_mut().integrator = Integrator::Rk4;
//! let mut data = Data::new(&model);
//! (0..100).try_for_each(|_| step(&model, &mut data))?;
//! // Runge and Kutta's method is exact for a parabola.
//! assert!((data.state.qpos[2] + 0.5 * 9.81 * data.time().powi(2)).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod implicit;
pub mod integrate;
