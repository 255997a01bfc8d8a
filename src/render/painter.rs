//! What draws: the CPU renderer of this crate, or one that another crate brings, such as a GPU.
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_physics::{Data, forward};
//! use robohive_render::painter::{Cpu, Painters};
//! use robohive_render::picture::Channels;
//! use robohive_render::raster::Shot;
//! use robohive_render::scene::{Camera, SceneOptions};
//! use robohive_render::{Assets, Picture, Profile, Scene, Settings};
//!
//! let model = robohive_mjcf::load_str("<mujoco><worldbody><geom size='.5'/></worldbody></mujoco>")?.model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let assets = Assets::new(&model, Profile::Mujoco312)?;
//! let mut scene = Scene::new();
//! scene.update(&model, &data, Camera::free(&model).view(&model, &data)?, &SceneOptions::default())?;
//! let (settings, mut picture) = (Settings::of(&model), Picture::new(16, 16));
//! let shot = Shot { assets: &assets, scene: &scene, channels: Channels::DEPTH, picture: &mut picture };
//! Cpu.painter(&settings).paint(&settings, &mut [shot])?;
//! // The ball is nearer than the corners.
//! assert!(picture.depth[8 * 16 + 8] < picture.depth[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
