//! How a robot acts and how well it senses.

use crate::compat::Compat;

/// What a policy's actions mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ActionMode {
    /// Positions of joints.
    #[default]
    Position,
    /// Velocities of joints, held for one control period from the measured position.
    Velocity,
    /// Torques or forces of joints, held at what the actuator makes of them at the beginning of the control period.
    Torque,
}

impl std::fmt::Display for ActionMode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            ActionMode::Position => "pos",
            ActionMode::Velocity => "vel",
            ActionMode::Torque => "torque",
        })
    }
}

/// A name that no [`ActionMode`] has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownMode(String);

impl std::fmt::Display for UnknownMode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "no action mode '{}'; there are 'pos', 'vel' and 'torque'", self.0)
    }
}

impl std::error::Error for UnknownMode {}

impl std::str::FromStr for ActionMode {
    type Err = UnknownMode;

    fn from_str(name: &str) -> Result<ActionMode, UnknownMode> {
        [ActionMode::Position, ActionMode::Velocity, ActionMode::Torque]
            .into_iter()
            .find(|mode| mode.to_string() == name)
            .ok_or_else(|| UnknownMode(name.to_owned()))
    }
}

/// Distribution of the noise of sensors, in units of `noise_scale` × the sensor's `noise`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Noise {
    /// Uniform from -1 to 1.
    #[default]
    Uniform,
    /// Normal with standard deviation 1.
    Gaussian,
}

/// How a robot acts and senses. The default is RoboHive's: normalised positions, exact readings without delay.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// What actions mean.
    pub mode: ActionMode,
    /// Actions are between -1 and 1; otherwise they have units.
    pub normalized: bool,
    /// Factor of every sensor's noise; 0 for none.
    pub noise_scale: f64,
    /// Distribution of the noise.
    pub noise: Noise,
    /// Readings that are kept, the newest among them.
    pub history: usize,
    /// Age of a reading, in time steps of the model.
    pub delay_steps: usize,
    /// Largest further age, drawn for each reading, in time steps of the model. A reading is never older than the one
    /// before.
    pub jitter_steps: usize,
    /// Controls are rounded to single precision, as RoboHive's are when actions are `float32` and there is a config.
    pub single_precision: bool,
    /// Devices come from the registry, by the interfaces that the config names, instead of being simulated.
    pub hardware: bool,
    /// Whether peculiarities of the original are kept.
    pub compat: Compat,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            mode: ActionMode::Position,
            normalized: true,
            noise_scale: 0.0,
            noise: Noise::Uniform,
            history: 5,
            delay_steps: 0,
            jitter_steps: 0,
            single_precision: false,
            hardware: false,
            compat: Compat::Fixed,
        }
    }
}

impl Options {
    /// What actions mean.
    #[must_use]
    pub fn with_mode(mut self, mode: ActionMode) -> Self {
        self.mode = mode;
        self
    }

    /// Whether actions are between -1 and 1; otherwise they have units.
    #[must_use]
    pub fn with_normalized(mut self, normalized: bool) -> Self {
        self.normalized = normalized;
        self
    }

    /// Factor of every sensor's noise; 0 for none.
    #[must_use]
    pub fn with_noise_scale(mut self, noise_scale: f64) -> Self {
        self.noise_scale = noise_scale;
        self
    }

    /// Distribution of the noise.
    #[must_use]
    pub fn with_noise(mut self, noise: Noise) -> Self {
        self.noise = noise;
        self
    }

    /// Readings that are kept, the newest among them.
    #[must_use]
    pub fn with_history(mut self, history: usize) -> Self {
        self.history = history;
        self
    }

    /// Age of a reading, in time steps of the model.
    #[must_use]
    pub fn with_delay_steps(mut self, delay_steps: usize) -> Self {
        self.delay_steps = delay_steps;
        self
    }

    /// Largest further age, drawn for each reading, in time steps of the model.
    #[must_use]
    pub fn with_jitter_steps(mut self, jitter_steps: usize) -> Self {
        self.jitter_steps = jitter_steps;
        self
    }

    /// Whether controls are rounded to single precision.
    #[must_use]
    pub fn with_single_precision(mut self, single_precision: bool) -> Self {
        self.single_precision = single_precision;
        self
    }

    /// Whether devices come from the registry instead of being simulated.
    #[must_use]
    pub fn with_hardware(mut self, hardware: bool) -> Self {
        self.hardware = hardware;
        self
    }

    /// Whether peculiarities of the original are kept.
    #[must_use]
    pub fn with_compat(mut self, compat: Compat) -> Self {
        self.compat = compat;
        self
    }
}
