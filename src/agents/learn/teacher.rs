//! Who shows how a task is done.

use crate::error::PolicyError;
use control::{ControlError, Controller};
use env::Env;
use serde::{Deserialize, Serialize};

/// Who shows how a task is done. A teacher may see all of an environment.
pub trait Teacher {
    /// Prepares for an episode, which has been reset with a seed.
    ///
    /// # Errors
    /// The teacher is none for this environment.
    fn begin(&mut self, env: &Env, seed: u64) -> Result<(), PolicyError>;

    /// Chooses an action for the present state.
    ///
    /// # Errors
    /// The teacher is none for this environment, or does not know what to do.
    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError>;
}

/// Which demonstrations are asked for.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Lessons {
    /// Episodes that succeed.
    pub episodes: u64,
    /// Deviation of what is added to the actions that are taken, not to those that are remembered: the teacher shows how it gets back on
    /// its way (Laskey et al., 2017).
    pub noise: f64,
}

/// Who shows how a task is done, and how often.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Teaching {
    /// A controller's name, or the file of a policy.
    pub by: String,
    /// Which demonstrations are asked for.
    pub lessons: Lessons,
}

impl Teacher for Box<dyn Controller> {
    fn begin(&mut self, env: &Env, seed: u64) -> Result<(), PolicyError> {
        self.reset(env, seed).map_err(|error| failed(env, error))
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        Controller::act(&mut **self, env, action).map_err(|error| failed(env, error))
    }
}

fn failed(env: &Env, error: ControlError) -> PolicyError {
    PolicyError::Teacher { id: env.spec().id.clone(), message: error.to_string() }
}
