//! Several pictures at once, on all cores.

use super::renderer::Renderer;
use super::settings::Settings;
use crate::error::RenderError;
use crate::geometry::Assets;
use crate::picture::{Channels, Picture};
use crate::scene::Scene;

/// One picture to draw.
pub struct Shot<'a> {
    /// Triangles and textures of the scene's model.
    pub assets: &'a Assets,
    /// What is drawn.
    pub scene: &'a Scene,
    /// Which arrays are wanted.
    pub channels: Channels,
    /// Where they go, at its size.
    pub picture: &'a mut Picture,
}

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
    /// As [`Renderer::draw`], that of the first shot that fails; the others are drawn.
    pub fn draw(&mut self, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        let mut results = vec![Ok(()); shots.len()];
        let share = shots.len().div_ceil(self.renderers.len()).max(1);
        let parts = self.renderers.iter_mut().zip(shots.chunks_mut(share)).zip(results.chunks_mut(share));
        let draw =
            |((renderer, shots), results): ((&mut Renderer, &mut [Shot<'_>]), &mut [Result<(), _>])| {
                for (shot, result) in shots.iter_mut().zip(results) {
                    *result = renderer.draw(shot.assets, shot.scene, shot.channels, shot.picture);
                }
            };
        #[cfg(feature = "threads")]
        rayon::scope(|scope| parts.for_each(|part| scope.spawn(|_| draw(part))));
        #[cfg(not(feature = "threads"))]
        parts.for_each(draw);
        results.into_iter().collect()
    }
}
