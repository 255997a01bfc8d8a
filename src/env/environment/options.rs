//! How an environment is made.

use super::hardware::Hardware;
use crate::arguments::Arguments;
use crate::pictures::network::{Networks, NoNetworks};
use crate::pictures::rendering::Rendering;
use physics::Engine;
use render::painter::{Cpu, Painters};
use robot::Compat;
use std::sync::Arc;

/// How an environment is made.
#[derive(Clone)]
#[non_exhaustive]
pub struct Options {
    /// Seed of all draws; without one, zero.
    pub seed: u64,
    /// Whether quirks of the original are reproduced.
    pub compat: Compat,
    /// Settings that differ from the id's, by their names.
    pub changes: Arguments,
    /// What [`Env::render`](crate::Env::render) returns.
    pub rendering: Rendering,
    /// Networks for visual keys.
    pub networks: Arc<dyn Networks>,
    /// What draws.
    pub painters: Arc<dyn Painters>,
    /// A bad number in the physics resets it as MuJoCo does, in the middle of the episode, instead of ending that
    /// (`Data::autoreset`).
    pub autoreset: bool,
    /// The engine of the simulation: by default our own pipeline.
    pub engine: Engine,
    /// The robot's devices, if it is not simulated.
    pub hardware: Option<Hardware>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            seed: 0,
            compat: Compat::Fixed,
            changes: Arguments::default(),
            rendering: Rendering::default(),
            networks: Arc::new(NoNetworks),
            painters: Arc::new(Cpu),
            autoreset: false,
            engine: Engine::default(),
            hardware: None,
        }
    }
}

impl Options {
    /// Seed of all draws.
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Whether quirks of the original are reproduced.
    #[must_use]
    pub fn with_compat(mut self, compat: Compat) -> Self {
        self.compat = compat;
        self
    }

    /// The robot's devices, if it is not simulated.
    #[must_use]
    pub fn with_hardware(mut self, hardware: Option<Hardware>) -> Self {
        self.hardware = hardware;
        self
    }

    /// Settings that differ from the id's, by their names.
    #[must_use]
    pub fn with_changes(mut self, changes: Arguments) -> Self {
        self.changes = changes;
        self
    }

    /// What [`Env::render`](crate::Env::render) returns.
    #[must_use]
    pub fn with_rendering(mut self, rendering: Rendering) -> Self {
        self.rendering = rendering;
        self
    }

    /// Networks for visual keys.
    #[must_use]
    pub fn with_networks(mut self, networks: Arc<dyn Networks>) -> Self {
        self.networks = networks;
        self
    }

    /// What draws.
    #[must_use]
    pub fn with_painters(mut self, painters: Arc<dyn Painters>) -> Self {
        self.painters = painters;
        self
    }

    /// Sets the engine of the simulation.
    #[must_use]
    pub fn with_engine(mut self, engine: Engine) -> Self {
        self.engine = engine;
        self
    }

    /// Whether a bad number in the physics resets it in the middle of the episode.
    #[must_use]
    pub fn with_autoreset(mut self, autoreset: bool) -> Self {
        self.autoreset = autoreset;
        self
    }
}
