//! An environment whose robot is hardware: its state is what the devices say, and time is not ours to choose.

use crate::error::NotReady;
use robot::{Clock, Config, Pacer, Registry};
use std::fmt;
use std::sync::Arc;

/// Prepares the surroundings once the robot stands where an episode begins, at these positions: asks a person, or puts
/// things back.
pub type Ready = Arc<dyn Fn(&[f64]) -> Result<(), NotReady> + Send + Sync>;

/// Devices in the place of a simulation.
///
/// A step sends the action to the devices and waits for the control period to pass; the state of the model then mirrors what
/// they read, so that the same task computes observations and rewards. What no sensor reads stays as the reset left it.
#[derive(Clone)]
pub struct Hardware {
    /// Drivers by the type of interface.
    pub registry: Arc<Registry>,
    /// Waits for control periods to pass.
    pub clock: Arc<dyn Fn() -> Box<dyn Clock + Send> + Send + Sync>,
    /// Called in every reset.
    pub ready: Ready,
    /// The robot's config, if not the environment's own.
    pub config: Option<Config>,
}

impl fmt::Debug for Hardware {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Hardware")
            .field("kinds", &self.registry.kinds().collect::<Vec<_>>())
            .finish_non_exhaustive()
    }
}

/// Hardware in use.
pub(crate) struct Live {
    pub(crate) pacer: Pacer<Box<dyn Clock + Send>>,
    pub(crate) ready: Ready,
    /// Time of the episode's first reading \[s\].
    pub(crate) begun: Option<f64>,
    /// A command was sent in this episode.
    pub(crate) commanded: bool,
}

impl Live {
    pub(crate) fn new(hardware: &Hardware) -> Live {
        Live {
            pacer: Pacer::new((hardware.clock)()),
            ready: hardware.ready.clone(),
            begun: None,
            commanded: false,
        }
    }
}
