//! How an environment is made.

use crate::arguments::Arguments;
use crate::pictures::network::{Networks, NoNetworks};
use crate::pictures::rendering::Rendering;
use render::painter::{Cpu, Painters};
use robot::Compat;
use std::sync::Arc;

/// How an environment is made.
#[derive(Clone)]
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
        }
    }
}
