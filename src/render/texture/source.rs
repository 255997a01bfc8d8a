//! The pixels of a texture as a model stores them.

use crate::error::RenderError;
use physics::Model;
use physics::model::{ColorSpace, ObjType, TextureType};
use std::ops::Range;

/// Most columns or rows of an image. Places in it are counted in 1/256 pixel, exactly in `f32` up to 2^22.
pub(super) const MAX_SIDE: usize = 1 << 14;

/// Pixels of one texture.
pub(super) struct Image<'a> {
    /// Columns.
    pub width: usize,
    /// Rows; for a cube, the rows of all faces that it stores.
    pub height: usize,
    /// Bytes a pixel, 3 or 4.
    channels: usize,
    /// It is looked up by direction.
    pub cube: bool,
    /// Its numbers are sRGB encoded.
    pub srgb: bool,
    data: &'a [u8],
}

impl<'a> Image<'a> {
    /// The image of a texture; none where its encoding cannot be drawn.
    pub fn of(model: &'a Model, id: usize) -> Result<Option<Self>, RenderError> {
        let range = byte_range(model, id)?;
        let channels = model.tex_nchannel[id] as usize;
        if !matches!(channels, 3 | 4) {
            return Ok(None);
        }
        let [width, height] = [model.tex_width[id] as usize, model.tex_height[id] as usize];
        let cube = model.tex_type[id] != TextureType::Texture2d as i32;
        let fail = |message: &str| RenderError::Model {
            message: format!("{} of {width}x{height} pixels {message}", model.label_of(ObjType::Texture, id)),
        };
        if width > MAX_SIDE || height > if cube { 6 * MAX_SIDE } else { MAX_SIDE } {
            return Err(fail(&format!("has a side longer than {MAX_SIDE} pixels")));
        }
        if cube && height != width && height != 6 * width {
            return Err(fail("is a cube, but consists of neither one square nor six"));
        }
        let srgb = model.tex_colorspace[id] == ColorSpace::Srgb as i32;
        Ok(Some(Image { width, height, channels, cube, srgb, data: &model.tex_data[range] }))
    }

    /// Writes the pixels of a row, packed as red, green, blue, alpha from the lowest byte on.
    pub fn write_row(&self, row: usize, out: &mut [u32]) {
        let stride = self.width * self.channels;
        let bytes = &self.data[row * stride..(row + 1) * stride];
        match self.channels {
            3 => out.iter_mut().zip(bytes.chunks_exact(3)).for_each(|(pixel, p)| {
                *pixel = u32::from_le_bytes([p[0], p[1], p[2], 255]);
            }),
            _ => out.iter_mut().zip(bytes.chunks_exact(4)).for_each(|(pixel, p)| {
                *pixel = u32::from_le_bytes([p[0], p[1], p[2], p[3]]);
            }),
        }
    }
}

/// Where the pixels of a texture lie in `tex_data`.
pub(super) fn byte_range(model: &Model, id: usize) -> Result<Range<usize>, RenderError> {
    let sides = [model.tex_width[id], model.tex_height[id], model.tex_nchannel[id]];
    let bytes = sides.into_iter().try_fold(1, |product: usize, side| {
        let side = usize::try_from(side).ok().filter(|&side| side > 0)?;
        product.checked_mul(side)
    });
    let range = usize::try_from(model.tex_adr[id]).ok().zip(bytes).and_then(|(start, bytes)| {
        let end = start.checked_add(bytes)?;
        (end <= model.tex_data.len()).then_some(start..end)
    });
    range.ok_or_else(|| {
        let [width, height, channels] = sides;
        let label = model.label_of(ObjType::Texture, id);
        let (first, length) = (model.tex_adr[id], model.tex_data.len());
        RenderError::Model {
            message: format!(
                "{label} has {width}x{height} pixels of {channels} bytes from byte {first} on, of {length} in the model"
            ),
        }
    })
}
