//! What draws pictures: the CPU, or a GPU in builds that can ask one.
//!
//! ```
//! use robohive_library::Renderer;
//!
//! let renderer: Renderer = "cpu".parse()?;
//! assert_eq!(renderer, Renderer::Cpu);
//! assert!(renderer.painters().is_ok());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use render::painter::{Cpu, Painters};
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// What is asked to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Renderer {
    /// The CPU.
    #[default]
    Cpu,
    /// The fastest GPU, or the first whose name contains this text.
    Gpu(Option<String>),
}

impl FromStr for Renderer {
    type Err = RendererError;

    fn from_str(text: &str) -> Result<Self, RendererError> {
        match text.split_once(':') {
            None if text == "cpu" => Ok(Renderer::Cpu),
            None if text == "gpu" => Ok(Renderer::Gpu(None)),
            Some(("gpu", name)) if !name.is_empty() => Ok(Renderer::Gpu(Some(name.to_owned()))),
            _ => Err(RendererError),
        }
    }
}

/// A text that names no renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RendererError;

impl fmt::Display for RendererError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("cpu, gpu, or gpu:NAME with a part of the GPU's name")
    }
}

impl std::error::Error for RendererError {}

/// This build has no feature `gpu`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoGpu;

impl Renderer {
    /// What draws. A GPU is opened when it draws first; on a machine without a GPU the CPU draws, and a line on the standard
    /// error stream says so.
    ///
    /// # Errors
    /// A GPU is asked for, and this build knows none.
    pub fn painters(&self) -> Result<Arc<dyn Painters>, NoGpu> {
        match self {
            Renderer::Cpu => Ok(Arc::new(Cpu)),
            Renderer::Gpu(name) => gpu(name.as_deref()),
        }
    }
}

#[cfg(feature = "gpu")]
fn gpu(name: Option<&str>) -> Result<Arc<dyn Painters>, NoGpu> {
    use render_gpu::{Choice, EitherPainters};
    let choice = name.map_or(Choice::Fastest, |name| Choice::Named(name.to_owned()));
    Ok(Arc::new(EitherPainters::new(choice)))
}

#[cfg(not(feature = "gpu"))]
fn gpu(_: Option<&str>) -> Result<Arc<dyn Painters>, NoGpu> {
    Err(NoGpu)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn renderers_are_the_cpu_or_a_gpu() {
        assert_eq!("cpu".parse(), Ok(Renderer::Cpu));
        assert_eq!("gpu".parse(), Ok(Renderer::Gpu(None)));
        assert_eq!("gpu:RTX".parse(), Ok(Renderer::Gpu(Some("RTX".into()))));
        for wrong in ["", "GPU", "gpu:", "cpu:x", "cuda"] {
            assert!(
                wrong.parse::<Renderer>().is_err_and(|error| error.to_string().contains("gpu:NAME")),
                "{wrong}"
            );
        }
    }

    #[test]
    fn a_gpu_needs_a_build_that_can_ask_one() {
        assert_eq!(Renderer::Gpu(None).painters().err(), (!cfg!(feature = "gpu")).then_some(NoGpu));
    }
}
