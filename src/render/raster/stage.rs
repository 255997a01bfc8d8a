//! What the passes of one picture read.

use super::draws::{Draw, Draws};
use super::layer::Layer;
use super::visibility::Visibility;
use super::window::lens::Lens;
use crate::geometry::Assets;
use crate::scene::Scene;

/// A scene under one projection.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    /// Triangles and textures.
    pub assets: &'a Assets,
    /// What there is to draw.
    pub scene: &'a Scene,
    /// Its surfaces.
    pub draws: &'a Draws,
    /// Their window positions.
    pub layer: &'a Layer,
    /// The projection.
    pub lens: &'a Lens,
}

impl Stage<'_> {
    /// Finds what is seen at the samples of a window, among the draws that `wanted` picks.
    pub fn look(&self, visibility: &mut Visibility, wanted: impl Fn(&Draw) -> bool) {
        let pattern = visibility.pattern;
        for (index, draw) in self.draws.list.iter().enumerate().filter(|(_, draw)| wanted(draw)) {
            self.layer.triangles(self.assets, (index, draw), self.lens, &pattern, |number, triangle| {
                visibility.draw(number, triangle);
            });
        }
    }
}
