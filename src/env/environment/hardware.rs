//! An environment whose robot is hardware: its state is what the devices say, and time is not ours to choose.

use crate::error::{EnvError, NotReady};
use crate::pictures::cameras::{CameraError, Cameras};
use crate::pictures::visual::VisualKey;
use robot::{Clock, Config, Pacer, Registry};
use std::fmt;
use std::sync::Arc;

/// Prepares the surroundings once the robot stands where an episode begins, at these positions: asks a person, or puts
/// things back.
pub type Ready = Arc<dyn Fn(&[f64]) -> Result<(), NotReady> + Send + Sync>;

/// Opens the cameras of a robot's config.
pub type OpenCameras = Arc<dyn Fn(&Config) -> Result<Box<dyn Cameras>, CameraError> + Send + Sync>;

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
    /// Opens the cameras for visual keys, if there are any. Without it the images are renderings of the state that mirrors the devices.
    pub cameras: Option<OpenCameras>,
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
    /// The cameras for visual keys.
    pub(crate) cameras: Option<Box<dyn Cameras>>,
}

impl Live {
    /// Opens the cameras, if there are visual keys.
    pub(crate) fn new(
        hardware: &Hardware,
        config: Option<&Config>,
        keys: &[VisualKey],
    ) -> Result<Live, EnvError> {
        let open = hardware.cameras.as_ref().filter(|_| !keys.is_empty());
        let cameras = open.map(|open| open(config.unwrap_or(&Config::default()))).transpose();
        let cameras = cameras.map_err(|error| EnvError::Camera { message: error.into() })?;
        let names = cameras.as_ref().map_or_else(Vec::new, |cameras| cameras.names());
        if let Some(key) = keys.iter().find(|key| cameras.is_some() && !names.contains(&key.camera)) {
            let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            return Err(EnvError::Camera {
                message: format!(
                    "the visual key {key} needs a camera '{}', and the robot's config has no such device with the interface \
                     'camera' or 'realsense'; its cameras are: {there}. Add it, or set visual_keys to what there is",
                    key.camera
                ),
            });
        }
        Ok(Live {
            pacer: Pacer::new((hardware.clock)()),
            ready: hardware.ready.clone(),
            begun: None,
            commanded: false,
            cameras,
        })
    }
}
