//! Several pictures at once, on all cores.

use super::renderer::{Renderer, Shot};
use super::settings::Settings;
use crate::error::RenderError;

/// Draws pictures on several threads, each as it would be drawn alone.
#[derive(Clone, Debug)]
pub struct Batch {
    renderers: Vec<Renderer>,
}

impl Batch {
    /// A batch on up to `threads` threads of the current pool.
    pub fn new(settings: Settings, threads: usize) -> Self {
        Batch { renderers: vec![Renderer::new(settings); threads.max(1)] }
    }

    /// Draws all shots.
    ///
    /// # Errors
    /// The error of [`Renderer::draw`] for the first shot that fails; all other shots are drawn.
    pub fn draw(&mut self, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        let mut results = vec![Ok(()); self.renderers.len()];
        let share = shots.len().div_ceil(self.renderers.len()).max(1);
        let parts = self.renderers.iter_mut().zip(shots.chunks_mut(share)).zip(&mut results);
        let draw = |((renderer, shots), result): ((&mut Renderer, &mut [Shot<'_>]), &mut Result<_, _>)| {
            *result = renderer.draw_all(shots);
        };
        #[cfg(feature = "threads")]
        rayon::scope(|scope| parts.for_each(|part| scope.spawn(|_| draw(part))));
        #[cfg(not(feature = "threads"))]
        parts.for_each(draw);
        results.into_iter().collect()
    }
}
