//! Pictures of an environment for people.

use super::env::Env;
use crate::error::EnvError;
use crate::pictures::rendering::{RenderMode, Rendering};
use crate::pictures::sight::Shot;
use render::Picture;
use render::picture::Channels;
use render::scene::Camera;

impl Env {
    /// A picture of the true state, as [`Options::rendering`](crate::Options::rendering) asks for it; `None` without a mode.
    ///
    /// # Errors
    /// The model has no such camera, the size is impossible, or the model cannot be drawn.
    pub fn render(&mut self) -> Result<Option<&Picture>, EnvError> {
        let Rendering { mode, camera, width, height } = &self.rendering;
        let channels = match mode {
            None => return Ok(None),
            Some(RenderMode::RgbArray) => Channels::RGB,
            Some(RenderMode::DepthArray) => Channels::DEPTH,
        };
        (self.rendered.width, self.rendered.height) = (*width, *height);
        let camera = Camera::named(&self.scene.model, camera)?;
        let shot = Shot { camera, channels, picture: &mut self.rendered };
        self.sight.draw(&self.scene.model, &self.scene.data, [shot])?;
        Ok(Some(&self.rendered))
    }

    /// Draws channels of a picture of the true state, at the picture's size, from a camera of the model or the one that is
    /// called `free`.
    ///
    /// # Errors
    /// As [`Env::render`].
    pub fn draw(&mut self, camera: &str, channels: Channels, picture: &mut Picture) -> Result<(), EnvError> {
        let camera = Camera::named(&self.scene.model, camera)?;
        self.sight.draw(&self.scene.model, &self.scene.data, [Shot { camera, channels, picture }])
    }

    /// Which MuJoCo's pictures are followed: RoboHive's own, 3.1.3, where its quirks are reproduced, otherwise 3.12.
    pub fn profile(&self) -> render::Profile {
        self.sight.profile()
    }
}
