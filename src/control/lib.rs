//! Controllers: what solves RoboHive's tasks without learning.
//!
//! A [`Controller`] sees the whole of an environment, its model and state among it, and chooses actions. [`controllers`] lists
//! those that are built in, each with the tasks or ids that it serves; [`make`] makes one for an environment. The mathematics
//! that they share is in [`maths`], a file for each method, and knows models and states but no environments. Adaptors to
//! environments are in `tasks/`, a file for each task.
//!
//! ```
//! # use env as robohive_env;
//! use robohive_control::{make, serving};
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let mut env = Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default())?;
//! assert_eq!(serving(env.spec()).next().map(|entry| entry.name), Some("reach"));
//! let (mut controller, mut action) = (make("reach", &env)?, vec![0.0; env.action_len()]);
//! env.reset(Some(3))?;
//! controller.reset(&env, 3)?;
//! while !env.verdict().solved {
//!     controller.act(&env, &mut action)?;
//!     assert!(!env.step(&action)?.truncated);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod controller;
mod error;
pub mod maths;
mod registry;
mod tasks;

pub use controller::Controller;
pub use error::ControlError;
pub use registry::{Entry, controllers, make, serving};
