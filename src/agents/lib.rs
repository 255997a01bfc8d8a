//! Policies: what chooses actions in RoboHive's environments.
//!
//! [`Policy::open`] reads a policy that was trained for the original; [`Policy::action`] asks it what to do in the present
//! state of an environment; [`learn`] trains one. Agents see observations and rewards, never the model or the state of the physics.
//!
//! ```
//! use robohive_agents::Policy;
//! # use env as robohive_env;
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default())?;
//! env.reset(Some(1))?;
//! let (mut policy, mut action) = (Policy::random(5), vec![0.0; env.action_len()]);
//! policy.action(&env, &mut action)?;
//! assert!(action.iter().all(|value| (-1.0..=1.0).contains(value)) && action[0] != action[1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod archive;
mod error;
pub mod learn;
mod mjrl;
pub mod nets;
mod network;
mod observation;
mod policy;
pub mod run;
pub mod statistics;
pub mod sweep;

pub use error::PolicyError;
pub use network::{Layer, Network};
pub use policy::{Mean, Policy, Trained};
