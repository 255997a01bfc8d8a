//! What draws pictures: the CPU, or a GPU in builds that can ask one.

use crate::failure::Failure;
use clap::Args;
use library::{NoGpu, Renderer};
use render::Painters;
use std::sync::Arc;

/// What draws.
#[derive(Args)]
pub struct RendererArguments {
    /// What draws: cpu, gpu, or gpu:NAME for the one whose name contains NAME [default: cpu]
    #[arg(long, value_name = "cpu|gpu|gpu:NAME")]
    renderer: Option<Renderer>,
}

impl RendererArguments {
    /// What draws. A GPU is opened when it draws first; on a machine without a GPU the CPU draws, and a line says so.
    ///
    /// # Errors
    /// A GPU is asked for, and this build knows none.
    pub fn painters(&self) -> Result<Arc<dyn Painters>, Failure> {
        let chosen = self.renderer.clone().unwrap_or_default();
        chosen.painters().map_err(|NoGpu| {
            Failure::usage(
                "this build draws on the CPU alone; `cargo install --path src/cli --features gpu` installs one that asks a GPU",
            )
        })
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
