//! What can be wrong with a picture drawn by a GPU, in whole sentences.

use render::RenderError;
use std::fmt;

/// Why the GPU draws nothing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GpuError {
    /// No GPU is what was asked for.
    NoAdapter {
        /// What was asked for.
        wanted: String,
        /// Names of the GPUs that there are.
        found: Vec<String>,
    },
    /// The GPU cannot do what pictures need.
    Unsuitable {
        /// Its name.
        adapter: String,
        /// What it lacks.
        message: String,
    },
    /// The driver gave no access to the GPU.
    NoDevice {
        /// Its name.
        adapter: String,
        /// What the driver says.
        message: String,
    },
    /// The GPU was lost: its driver was reset, or it was taken away.
    Lost {
        /// What the driver says.
        message: String,
    },
    /// The memory of the GPU does not suffice.
    OutOfMemory,
    /// The driver refused a command.
    Refused {
        /// What it says.
        message: String,
    },
    /// The scene has an effect that a GPU does not draw.
    Effect {
        /// Its name.
        name: &'static str,
    },
    /// The scene or the picture is at fault; the CPU renderer says the same.
    Render(RenderError),
}

impl fmt::Display for GpuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GpuError::NoAdapter { wanted, found } => {
                write!(f, "there is no GPU {wanted}")?;
                match found.as_slice() {
                    [] => write!(f, ": no driver for Vulkan, Metal or Direct3D 12 was found"),
                    names => write!(f, "; there are: {}", names.join(", ")),
                }
            }
            GpuError::Unsuitable { adapter, message } => {
                write!(f, "{adapter} cannot draw pictures: {message}")
            }
            GpuError::NoDevice { adapter, message } => write!(f, "{adapter} cannot be opened: {message}"),
            GpuError::Lost { message } => {
                write!(f, "the GPU was lost ({message}); make a new renderer to go on")
            }
            GpuError::OutOfMemory => {
                write!(f, "the memory of the GPU does not suffice; draw fewer or smaller pictures at once")
            }
            GpuError::Refused { message } => write!(f, "the driver of the GPU refused a command: {message}"),
            GpuError::Effect { name } => {
                write!(
                    f,
                    "a GPU draws no {name}; draw this scene with the CPU renderer, robohive_render::Renderer"
                )
            }
            GpuError::Render(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for GpuError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            GpuError::Render(error) => Some(error),
            _ => None,
        }
    }
}

impl From<RenderError> for GpuError {
    fn from(error: RenderError) -> Self {
        GpuError::Render(error)
    }
}

impl From<GpuError> for RenderError {
    fn from(error: GpuError) -> Self {
        match error {
            GpuError::Render(error) => error,
            error => RenderError::Device { message: error.to_string() },
        }
    }
}
