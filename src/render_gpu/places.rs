//! Where the surfaces and textures of a model lie in the memory of the GPU, which several models share.

use crate::meshes::Meshes;
use crate::textures::Textures;
use render::Assets;
use render::scene::Scene;
use std::sync::Arc;

/// Numbers in the memory of the GPU, by those in the assets of one model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Places {
    /// Of each surface.
    pub surfaces: Vec<usize>,
    /// Of each texture.
    pub textures: Vec<usize>,
}

impl Places {
    /// Those of a model whose surfaces and textures have been uploaded.
    pub fn of(assets: &Assets, meshes: &Meshes, textures: &Textures) -> Self {
        Places {
            surfaces: assets.surfaces.iter().map(|surface| meshes.number(surface)).collect(),
            textures: assets.textures.iter().map(|texture| textures.number(texture)).collect(),
        }
    }
}

/// What one picture of a batch shows.
#[derive(Clone, Debug)]
pub struct Seen<'a> {
    /// Surfaces and textures of its model.
    pub assets: &'a Assets,
    /// Where they lie.
    pub places: Arc<Places>,
    /// What is drawn.
    pub scene: &'a Scene,
}
