//! Visual domain randomisation: textures, colours, lights, cameras and distractors that differ from episode to episode.
//!
//! What is written leaves the motion as it is: distractors must be bodies that touch nothing. Sensors that look through a
//! camera see that it moved.

mod choice;
mod config;
mod target;
mod texture;

pub use config::{
    CameraRange, DistractorRange, LightRange, MaterialRange, Pattern, TextureRange, VisualRandomization,
};

use super::drawn::Drawn;
use physics::Model;
use target::Seen;

/// What changes in the look of an environment, and how it looks now.
pub(crate) type Look = Drawn<Seen>;

impl Look {
    /// Finds what a configuration names.
    ///
    /// # Errors
    /// A name or range that is wrong.
    pub(crate) fn new(config: &VisualRandomization, model: &Model, seed: u64) -> Result<Self, String> {
        Ok(Drawn::of(choice::dials(config, model)?, model, seed))
    }
}
