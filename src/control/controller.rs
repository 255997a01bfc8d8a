//! What a controller is, and what controllers write their actions with.

use crate::error::ControlError;
use env::Env;

/// Acts in one environment, of which it may see everything.
///
/// A controller remembers what it needs from step to step. Its actions follow from the environment's state, from what it
/// remembers and from the seed of [`Controller::reset`] alone, so that episodes repeat.
pub trait Controller: Send {
    /// Prepares for the episode that has just begun: the environment was reset. `seed` decides the controller's own draws, if it
    /// makes any.
    ///
    /// # Errors
    /// The state admits no plan; a model that does not fit.
    fn reset(&mut self, env: &Env, seed: u64) -> Result<(), ControlError>;

    /// Writes the action for the present state: `action` is as long as the environment's actions, in the units of its action
    /// space.
    ///
    /// # Errors
    /// No action can be computed.
    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError>;
}

/// Writes the action by which actuators get `controls` (nu, in units of the actuators). Beyond the limits it is the nearest one.
pub(crate) fn command(env: &Env, controls: &[f64], action: &mut [f64]) -> Result<(), ControlError> {
    action.copy_from_slice(controls);
    if env.settings().normalize_act {
        env.robot().normalize(&env.scene().model, action).map_err(env::EnvError::from)?;
    }
    for (k, value) in action.iter_mut().enumerate() {
        let [low, high] = env.action_bounds(k);
        *value = value.max(low).min(high);
    }
    Ok(())
}
