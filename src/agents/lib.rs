//! Policies: what chooses actions in RoboHive's environments.
//!
//! [`Policy::open`] reads a policy that was trained for the original; [`Policy::action`] asks it what to do in the present
//! state of an environment. Agents see observations and rewards, never the model or the state of the physics.

mod error;
mod mjrl;
mod network;
mod observation;
mod policy;

pub use error::PolicyError;
pub use network::{Layer, Network};
pub use policy::Policy;
