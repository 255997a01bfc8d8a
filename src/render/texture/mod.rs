//! Textures: chains of mip levels, and the filters that read them.
//!
//! Images and filters agree with Mesa's software rasteriser, which draws MuJoCo's pictures on machines without a GPU:
//! textures that are not sRGB are filtered in integers with weights of 1/256, to the bit; sRGB and cube textures in `f32`.

mod cube;
mod flat;
mod halving;
mod lerp;
mod level_image;
mod lod;
mod source;
mod srgb;

pub use level_image::LevelImage;

use cube::CubeMap;
use flat::FlatMap;
use source::Image;

use crate::error::RenderError;
use crate::profile::Profile;
use physics::Model;
use std::ops::Range;

/// One texture of a model.
#[derive(Clone, Debug, Default)]
pub struct Texture {
    map: Map,
}

#[derive(Clone, Debug, Default)]
enum Map {
    /// An encoding that MuJoCo's renderer does not draw.
    #[default]
    Empty,
    Flat(FlatMap),
    Cube(CubeMap),
}

impl Texture {
    /// Prepares a texture of the model. One with neither 3 nor 4 bytes a pixel is left empty, as MuJoCo does.
    ///
    /// # Errors
    /// [`RenderError::Model`] for pixels outside `tex_data`, sizes that are zero or above 16384, or a cube whose
    /// faces are not squares.
    pub fn new(model: &Model, id: usize, profile: Profile) -> Result<Texture, RenderError> {
        Ok(Texture {
            map: match Image::of(model, id)? {
                None => Map::Empty,
                Some(image) if image.cube => Map::Cube(CubeMap::new(&image)),
                Some(image) => Map::Flat(FlatMap::new(&image, image.srgb && profile == Profile::Mujoco312)),
            },
        })
    }

    /// Which bytes of the model's `tex_data` are the texture's.
    pub(crate) fn bytes_in(model: &Model, id: usize) -> Result<Range<usize>, RenderError> {
        source::byte_range(model, id)
    }

    /// There is nothing to draw: surfaces keep their own colour.
    pub fn is_empty(&self) -> bool {
        matches!(self.map, Map::Empty)
    }

    /// It is looked up by direction.
    pub fn is_cube(&self) -> bool {
        matches!(self.map, Map::Cube(_))
    }

    /// Its numbers are decoded from sRGB before they are filtered.
    pub fn is_srgb(&self) -> bool {
        matches!(&self.map, Map::Flat(map) if map.is_srgb())
    }

    /// Images of its mip levels, the finest first; of a cube, the faces of a level in the order +x, -x, +y, -y, +z, -z.
    pub fn images(&self) -> Vec<LevelImage<'_>> {
        match &self.map {
            Map::Empty => Vec::new(),
            Map::Flat(map) => map.images().collect(),
            Map::Cube(map) => map.images().collect(),
        }
    }

    /// Bytes that its mip levels take.
    pub fn bytes(&self) -> usize {
        match &self.map {
            Map::Empty => 0,
            Map::Flat(map) => map.bytes(),
            Map::Cube(map) => map.bytes(),
        }
    }

    /// Colour and opacity, 0 to 1, at texture coordinates that repeat; row 0 of the image is at t = 0. Levels of detail
    /// up to 0 magnify. White for a texture that is not two-dimensional.
    pub fn sample_2d(&self, s: f32, t: f32, lod: f32) -> [f32; 4] {
        match &self.map {
            Map::Flat(map) => map.sample(s, t, lod),
            _ => [1.0; 4],
        }
    }

    /// Colour and opacity, 0 to 1, in a direction of any length but 0. White for a texture that is not a cube.
    pub fn sample_cube(&self, direction: [f32; 3], lod: f32) -> [f32; 4] {
        match &self.map {
            Map::Cube(map) => map.sample(direction, lod),
            _ => [1.0; 4],
        }
    }

    /// Level of detail at texture coordinates that change by `(ds_dx, dt_dx)` and `(ds_dy, dt_dy)` from one pixel to the
    /// next along x and y.
    pub fn lod_2d(&self, ds_dx: f32, dt_dx: f32, ds_dy: f32, dt_dy: f32) -> f32 {
        match &self.map {
            Map::Flat(map) => map.lod([ds_dx, dt_dx], [ds_dy, dt_dy]),
            _ => 0.0,
        }
    }

    /// Level of detail in a direction that changes by `dx` and `dy` from one pixel to the next along x and y.
    pub fn lod_cube(&self, direction: [f32; 3], dx: [f32; 3], dy: [f32; 3]) -> f32 {
        match &self.map {
            Map::Cube(map) => map.lod(direction, dx, dy),
            _ => 0.0,
        }
    }
}
