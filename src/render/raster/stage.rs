//! What the passes of one picture read.

use super::draws::Draws;
use super::layer::{Layer, Lens};
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
