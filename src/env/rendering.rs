//! Pictures for people: what `render` of an environment returns.

use crate::environment::Env;
use crate::error::EnvError;
use crate::message::message;
use crate::sight::Shot;
use render::Picture;
use render::picture::Channels;
use render::scene::Camera;
use std::fmt;
use std::str::FromStr;

message! {
    /// A render mode that does not exist, with those that do.
    RenderModeError
}

/// What [`Env::render`] returns (Gymnasium's `render_mode`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RenderMode {
    /// Colours.
    RgbArray,
    /// Depth [m].
    DepthArray,
}

impl FromStr for RenderMode {
    type Err = RenderModeError;

    fn from_str(name: &str) -> Result<Self, RenderModeError> {
        match name {
            "rgb_array" => Ok(RenderMode::RgbArray),
            "depth_array" => Ok(RenderMode::DepthArray),
            "human" => {
                Err("render_mode human needs a window, and this build opens none; rgb_array and depth_array \
                            return pictures to show or to save"
                    .into())
            }
            _ => Err(format!("render_mode is rgb_array or depth_array, not {name}").into()),
        }
    }
}

impl fmt::Display for RenderMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RenderMode::RgbArray => "rgb_array",
            RenderMode::DepthArray => "depth_array",
        })
    }
}

/// How [`Env::render`] draws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendering {
    /// What it returns; nothing without one.
    pub mode: Option<RenderMode>,
    /// Name of a camera of the model, or `free` for the one that the model starts with.
    pub camera: String,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Default for Rendering {
    /// No pictures; where they are switched on, 640 x 480 pixels from the free camera, as in the original.
    fn default() -> Self {
        Rendering { mode: None, camera: "free".into(), width: 640, height: 480 }
    }
}

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
