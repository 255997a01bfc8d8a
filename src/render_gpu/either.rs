//! The GPU where there is one, the CPU otherwise.

use crate::adapter::Choice;
use crate::error::GpuError;
use crate::renderer::GpuRenderer;
use render::picture::Channels;
use render::raster::Settings;
use render::scene::Scene;
use render::{Assets, Picture, Renderer};
use std::sync::Once;

/// A renderer on a GPU or on the CPU; both draw the same picture but for rounding.
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

    /// What draws, for people.
    pub fn name(&self) -> String {
        match self {
            EitherRenderer::Gpu(renderer) => renderer.adapter().to_string(),
            EitherRenderer::Cpu(_) => "CPU".into(),
        }
    }

    /// Draws a scene, as [`Renderer::draw`] does.
    ///
    /// # Errors
    /// As [`Renderer::draw`], or the GPU failed.
    pub fn draw(
        &mut self,
        assets: &Assets,
        scene: &Scene,
        channels: Channels,
        picture: &mut Picture,
    ) -> Result<(), GpuError> {
        match self {
            EitherRenderer::Gpu(renderer) => renderer.draw(assets, scene, channels, picture),
            EitherRenderer::Cpu(renderer) => Ok(renderer.draw(assets, scene, channels, picture)?),
        }
    }

    /// Draws scenes, as [`GpuRenderer::draw_batch`] does; on the CPU one after the other.
    ///
    /// # Errors
    /// As [`GpuRenderer::draw_batch`].
    pub fn draw_batch(
        &mut self,
        assets: &Assets,
        scenes: &[&Scene],
        channels: Channels,
        pictures: &mut [Picture],
    ) -> Result<(), GpuError> {
        match self {
            EitherRenderer::Gpu(renderer) => renderer.draw_batch(assets, scenes, channels, pictures),
            EitherRenderer::Cpu(_) if scenes.len() != pictures.len() => {
                Err(GpuError::Batch { scenes: scenes.len(), pictures: pictures.len() })
            }
            EitherRenderer::Cpu(renderer) => scenes
                .iter()
                .zip(pictures)
                .try_for_each(|(scene, picture)| Ok(renderer.draw(assets, scene, channels, picture)?)),
        }
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
