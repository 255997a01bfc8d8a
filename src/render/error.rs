//! What can be wrong with a picture, in whole sentences.
//!
//! ```
//! use robohive_render::error::{MAX_SIDE, RenderError};
//!
//! let error = RenderError::Size { width: MAX_SIDE + 1, height: 48 };
//! assert!(error.to_string().contains("4096"), "{error}");
//! ```

use std::fmt;

/// Why a picture cannot be drawn.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RenderError {
    /// The model has no camera of this name.
    UnknownCamera {
        /// What was asked for.
        name: String,
        /// Names of the cameras that there are.
        cameras: Vec<String>,
        /// The one nearest to it.
        nearest: Option<String>,
    },
    /// A picture without pixels, or one too large.
    Size {
        /// Columns asked for.
        width: usize,
        /// Rows asked for.
        height: usize,
    },
    /// A camera whose frustum is empty or not finite.
    Frustum {
        /// What is wrong with it.
        message: String,
    },
    /// A pose or size in the scene is not finite.
    NotFinite {
        /// What it belongs to.
        what: String,
    },
    /// An array of the model does not fit the renderer.
    Model {
        /// What is wrong with it.
        message: String,
    },
    /// What draws has failed, such as a GPU.
    Device {
        /// What it says.
        message: String,
    },
}

/// Most columns or rows of a picture.
pub const MAX_SIDE: usize = 4096;

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RenderError::UnknownCamera { name, cameras, nearest } => {
                write!(f, "the model has no camera named {name}")?;
                match nearest {
                    Some(nearest) => write!(f, "; did you mean {nearest}? ")?,
                    None => write!(f, ". ")?,
                }
                match cameras.as_slice() {
                    [] => write!(f, "It has none of its own; `free` is always there"),
                    names => write!(f, "Its cameras: {}, and `free`", names.join(", ")),
                }
            }
            RenderError::Size { width, height } => {
                write!(
                    f,
                    "a picture of {width}x{height} pixels cannot be drawn: give 1 to {MAX_SIDE} columns and rows"
                )
            }
            RenderError::Frustum { message } => write!(f, "the camera cannot see: {message}"),
            RenderError::NotFinite { what } => {
                write!(f, "{what} has a pose or size that is not finite, so there is nothing to draw")
            }
            RenderError::Model { message } => write!(f, "the model cannot be drawn: {message}"),
            RenderError::Device { message } => f.write_str(message),
        }
    }
}

impl std::error::Error for RenderError {}
