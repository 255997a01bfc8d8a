//! The order of all stages: forward and inverse dynamics, the step, and batches of steps.
//!
//! ```
//! use robohive_physics::{Data, step1, step2};
//!
//! let text = "<mujoco><worldbody><body><joint name='j' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody>
//!     <actuator><motor joint='j'/></actuator></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! // A controller between the halves of a step sees what follows from the state: here it carries the weight.
//! for _ in 0..100 {
//!     step1(&model, &mut data)?;
//!     data.state.ctrl[0] = data.vel.qfrc_bias[0];
//!     step2(&model, &mut data)?;
//! }
//! assert!(data.state.qpos[0].abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod appearance;
pub mod autoreset;
mod demand;
pub mod error;
pub mod forward;
#[doc(hidden)]
pub mod integrate;
pub mod inverse;
pub mod on_demand;
mod reset;
mod rest;
pub mod step;
pub mod stepper;
pub mod transition;
#[doc(hidden)]
pub mod validity;
pub mod watch;
