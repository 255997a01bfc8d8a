//! The GPU where there is one, the CPU otherwise.

use crate::adapter::Choice;
use crate::error::GpuError;
use crate::renderer::{GpuRenderer, missing};
use render::painter::{Painter, Painters};
use render::raster::{Settings, Shot};
use render::{RenderError, Renderer};
use std::sync::{Arc, Mutex, Once, PoisonError};

/// A renderer on a GPU or on the CPU; both draw the same picture but for rounding. Effects that a GPU does not have, such as
/// wireframes, are left to the CPU.
#[derive(Debug)]
pub enum EitherRenderer {
    /// On a GPU.
    Gpu(Box<GpuRenderer>),
    /// On the CPU.
    Cpu(Box<Renderer>),
}

impl EitherRenderer {
    /// A renderer on the chosen GPU. Where that cannot be had, one on the CPU, and a line on the standard error stream says
    /// so, once in a process.
    pub fn new(settings: Settings, choice: &Choice) -> Self {
        static SAID: Once = Once::new();
        GpuRenderer::new(settings, choice).map_or_else(
            |error| {
                SAID.call_once(|| eprintln!("{}", replaced(&error)));
                EitherRenderer::Cpu(Box::new(Renderer::new(settings)))
            },
            |renderer| EitherRenderer::Gpu(Box::new(renderer)),
        )
    }
}

impl Painter for EitherRenderer {
    fn paint(&mut self, settings: &Settings, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        match self {
            EitherRenderer::Gpu(_) if shots.iter().any(|shot| missing(shot.scene).is_some()) => {
                Renderer::new(*settings).draw_all(shots)
            }
            EitherRenderer::Gpu(renderer) => {
                renderer.set(settings)?;
                Ok(renderer.draw_batch(shots)?)
            }
            EitherRenderer::Cpu(renderer) => renderer.paint(settings, shots),
        }
    }

    fn draws_batches(&self) -> bool {
        matches!(self, EitherRenderer::Gpu(_))
    }

    fn name(&self) -> String {
        match self {
            EitherRenderer::Gpu(renderer) => renderer.adapter().to_string(),
            EitherRenderer::Cpu(renderer) => renderer.name(),
        }
    }
}

/// Painters on a GPU, or on the CPU where it cannot be had. One that is dropped is lent again, since it takes long to open a
/// GPU.
#[derive(Debug, Default)]
pub struct EitherPainters {
    choice: Choice,
    idle: Arc<Mutex<Vec<EitherRenderer>>>,
}

impl EitherPainters {
    /// Painters on the GPU that is chosen.
    pub fn new(choice: Choice) -> Self {
        EitherPainters { choice, idle: Arc::default() }
    }
}

impl Painters for EitherPainters {
    fn painter(&self, settings: &Settings) -> Box<dyn Painter> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let renderer = idle.unwrap_or_else(|| EitherRenderer::new(*settings, &self.choice));
        Box::new(Lent { renderer: Some(renderer), idle: self.idle.clone() })
    }
}

/// A renderer that returns to where it came from.
#[derive(Debug)]
struct Lent {
    renderer: Option<EitherRenderer>,
    idle: Arc<Mutex<Vec<EitherRenderer>>>,
}

impl Lent {
    fn renderer(&self) -> &EitherRenderer {
        self.renderer.as_ref().expect("only dropping it takes the renderer away")
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner).extend(self.renderer.take());
    }
}

impl Painter for Lent {
    fn paint(&mut self, settings: &Settings, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        self.renderer.as_mut().expect("only dropping it takes the renderer away").paint(settings, shots)
    }

    fn draws_batches(&self) -> bool {
        self.renderer().draws_batches()
    }

    fn name(&self) -> String {
        self.renderer().name()
    }
}

/// What is said when the CPU stands in.
fn replaced(error: &GpuError) -> String {
    format!("{error}. The CPU draws instead, with the same pictures")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_names_what_was_wanted_and_what_draws_instead() {
        let error =
            GpuError::NoAdapter { wanted: Choice::Fastest.to_string(), found: vec!["llvmpipe".into()] };
        let said = replaced(&error);
        assert_eq!(
            said,
            "there is no GPU made of hardware; there are: llvmpipe. The CPU draws instead, with the same pictures"
        );
    }
}
