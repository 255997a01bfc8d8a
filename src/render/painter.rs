//! What draws: the CPU renderer of this crate, or one that another crate brings, such as a GPU.

use crate::error::RenderError;
use crate::raster::{Renderer, Settings, Shot};
use std::fmt;

/// Something that draws scenes.
pub trait Painter: Send {
    /// Draws all shots as finely as `settings` say. Pictures after the first that fails may not be drawn.
    ///
    /// # Errors
    /// As [`Renderer::draw`]; [`RenderError::Device`] where what draws fails.
    fn paint(&mut self, settings: &Settings, shots: &mut [Shot<'_>]) -> Result<(), RenderError>;

    /// Whether many shots in one call take less time than one call for each.
    fn draws_batches(&self) -> bool {
        false
    }

    /// What it is, for people.
    fn name(&self) -> String;
}

/// Where painters come from.
pub trait Painters: Send + Sync + fmt::Debug {
    /// A painter with memory of its own.
    fn painter(&self, settings: &Settings) -> Box<dyn Painter>;
}

/// Painters on the CPU, whose pictures are the reference.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

impl Painters for Cpu {
    fn painter(&self, settings: &Settings) -> Box<dyn Painter> {
        Box::new(Renderer::new(*settings))
    }
}

impl Painter for Renderer {
    fn paint(&mut self, settings: &Settings, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        *self.settings_mut() = *settings;
        self.draw_all(shots)
    }

    fn name(&self) -> String {
        "CPU".into()
    }
}
