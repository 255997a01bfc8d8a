//! What draws pictures: the CPU, or a GPU in builds that can ask one.

use crate::Failure;
use clap::Args;
use render::Painters;
use std::str::FromStr;
use std::sync::Arc;

/// What draws.
#[derive(Args)]
pub struct RendererArguments {
    /// What draws: cpu, gpu, or gpu:NAME for the one whose name contains NAME [default: cpu]
    #[arg(long, value_name = "cpu|gpu|gpu:NAME")]
    renderer: Option<Renderer>,
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Renderer {
    Cpu,
    /// The fastest, or the first whose name contains this text.
    Gpu(Option<String>),
}

impl FromStr for Renderer {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            None if text == "cpu" => Ok(Renderer::Cpu),
            None if text == "gpu" => Ok(Renderer::Gpu(None)),
            Some(("gpu", name)) if !name.is_empty() => Ok(Renderer::Gpu(Some(name.to_owned()))),
            _ => Err("cpu, gpu, or gpu:NAME with a part of the GPU's name".into()),
        }
    }
}

impl RendererArguments {
    /// What draws. A GPU is opened when it draws first; where there is none, the CPU draws, and a line says so.
    ///
    /// # Errors
    /// A GPU is asked for, and this build knows none.
    pub fn painters(&self) -> Result<Arc<dyn Painters>, Failure> {
        match &self.renderer {
            None | Some(Renderer::Cpu) => Ok(Arc::new(render::painter::Cpu)),
            Some(Renderer::Gpu(name)) => gpu(name.as_deref()),
        }
    }

    /// The same for a command that draws if `draws` says so, which `options` decide.
    ///
    /// # Errors
    /// Something is asked for, and nothing is drawn.
    pub fn painters_if(&self, draws: bool, options: &str) -> Result<Arc<dyn Painters>, Failure> {
        match self.renderer {
            Some(_) if !draws => Err(Failure::usage(format!("--renderer is for {options}"))),
            _ => self.painters(),
        }
    }

    /// Whether a GPU is asked for.
    pub fn is_gpu(&self) -> bool {
        matches!(self.renderer, Some(Renderer::Gpu(_)))
    }
}

#[cfg(feature = "gpu")]
fn gpu(name: Option<&str>) -> Result<Arc<dyn Painters>, Failure> {
    use render_gpu::{Choice, EitherPainters};
    let choice = name.map_or(Choice::Fastest, |name| Choice::Named(name.to_owned()));
    Ok(Arc::new(EitherPainters::new(choice)))
}

#[cfg(not(feature = "gpu"))]
fn gpu(_: Option<&str>) -> Result<Arc<dyn Painters>, Failure> {
    Err(Failure::usage(
        "this build draws on the CPU alone; `cargo install --path src/cli --features gpu` installs one that asks a GPU",
    ))
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
            assert!(wrong.parse::<Renderer>().is_err_and(|error| error.contains("gpu:NAME")), "{wrong}");
        }
    }
}
