//! Pictures for people: what `render` of an environment returns.

use crate::message::message;
use std::fmt;
use std::str::FromStr;

message! {
    /// A render mode that does not exist, with those that do.
    RenderModeError
}

/// What [`Env::render`](crate::Env::render) returns (Gymnasium's `render_mode`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RenderMode {
    /// Colours.
    RgbArray,
    /// Depth \[m\].
    DepthArray,
}

impl FromStr for RenderMode {
    type Err = RenderModeError;

    fn from_str(name: &str) -> Result<Self, RenderModeError> {
        match name {
            "rgb_array" => Ok(RenderMode::RgbArray),
            "depth_array" => Ok(RenderMode::DepthArray),
            "human" => {
                Err("render_mode human is the window of one environment in Python; here rgb_array and depth_array return \
                     pictures to show or to save"
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

/// How [`Env::render`](crate::Env::render) draws.
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
