//! Who shows how a task is done.

use crate::error::PolicyError;
use env::Env;

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
