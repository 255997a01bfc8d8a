//! Textures: from one image, from six, or computed.

use super::builtin::{paint_cube, paint_flat_image};
use super::ktx;
use super::png::{self, Pixels};
use super::source::{Builtin, FileImage, MAX_BYTES, TextureSource};
use crate::asset::AssetError;
use physics::model::{ColorSpace, TextureType};

/// The rows one texture contributes to a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CompiledTexture {
    /// `tex_width`.
    pub width: usize,
    /// `tex_height`; six times the width for a cube with distinct faces.
    pub height: usize,
    /// `tex_nchannel`.
    pub nchannel: usize,
    /// `tex_colorspace`.
    pub colorspace: ColorSpace,
    /// `tex_data`: row-major from the top, faces in the order right, left, up, down, front, back.
    pub data: Vec<u8>,
}

const PNG: &str = "image/png";
const KTX: &str = "image/ktx";

/// Compiles one texture.
pub fn texture(source: &TextureSource) -> Result<CompiledTexture, AssetError> {
    if ![1, 3, 4].contains(&source.nchannel) {
        return Err(AssetError::unsupported(format!(
            "texture '{}': {} channels",
            source.name, source.nchannel
        )));
    }
    match (source.builtin, &source.file, source.kind) {
        (Builtin::None, Some(file), TextureType::Texture2d) => flat_file(source, file),
        (Builtin::None, Some(file), _) => cube_from_one(source, file),
        (Builtin::None, None, TextureType::Texture2d) => Err(AssetError::inconsistent(format!(
            "texture '{}' of type 2d needs a file or a builtin",
            source.name
        ))),
        (Builtin::None, None, _) => cube_from_six(source),
        (_, _, TextureType::Texture2d) => computed(source, source.height),
        _ => computed(source, source.width.saturating_mul(6)),
    }
}

fn computed(source: &TextureSource, height: usize) -> Result<CompiledTexture, AssetError> {
    let width = source.width;
    three_channels(source)?;
    if width == 0 || height == 0 {
        return Err(AssetError::inconsistent(format!(
            "texture '{}': a builtin needs positive width and height",
            source.name
        )));
    }
    let mut data = vec![0; byte_count(source, width, height, 3)?];
    match source.kind {
        TextureType::Texture2d => paint_flat_image(source, width, height, &mut data),
        TextureType::Cube | TextureType::Skybox => paint_cube(source, width, &mut data),
    }
    Ok(CompiledTexture { width, height, nchannel: 3, colorspace: source.colorspace, data })
}

fn flat_file(source: &TextureSource, file: &FileImage) -> Result<CompiledTexture, AssetError> {
    if content_type(source, file) == KTX {
        return container(source, file);
    }
    let image = load(source, file)?;
    Ok(CompiledTexture {
        width: image.width,
        height: image.height,
        nchannel: source.nchannel,
        colorspace: resolve(source.colorspace, image.srgb),
        data: image.data,
    })
}

/// A KTX container is kept as it is, one byte a pixel, for the renderer to decode.
fn container(source: &TextureSource, file: &FileImage) -> Result<CompiledTexture, AssetError> {
    if source.hflip || source.vflip {
        return Err(AssetError::inconsistent(format!("KTX texture '{}' cannot be flipped", file.path)));
    }
    ktx::check(&file.bytes, &file.path)?;
    Ok(CompiledTexture {
        width: byte_count(source, file.bytes.len(), 1, 1)?,
        height: 1,
        nchannel: 1,
        colorspace: resolve(source.colorspace, false),
        data: file.bytes.clone(),
    })
}

/// One image for all faces, or a grid of faces.
fn cube_from_one(source: &TextureSource, file: &FileImage) -> Result<CompiledTexture, AssetError> {
    three_channels(source)?;
    let [rows, columns] = source.gridsize;
    let fail = |why: &str| Err(AssetError::inconsistent(format!("texture '{}': {why}", source.name)));
    if rows == 0 || columns == 0 || rows.saturating_mul(columns) > 12 {
        return fail("gridsize must have 1 to 12 squares");
    }
    let image = load(source, file)?;
    let width = image.width / columns;
    if width != image.height / rows || image.width % columns != 0 || image.height % rows != 0 {
        return fail(
            "the image does not divide into square cells: change 'gridsize', or the size of the image",
        );
    }
    let colorspace = resolve(source.colorspace, image.srgb);
    if rows == 1 && columns == 1 {
        return Ok(CompiledTexture { width, height: width, nchannel: 3, colorspace, data: image.data });
    }
    let mut faces = Faces::new(source, width)?;
    for (cell, symbol) in source.gridlayout.chars().take(rows * columns).enumerate() {
        if symbol == '.' {
            continue;
        }
        let Some(face) = "RLUDFB".find(symbol) else {
            return fail("gridlayout symbols must be among '.RLUDFB'");
        };
        let (top, left) = (width * (cell / columns), width * (cell % columns));
        for row in 0..width {
            let from = 3 * ((top + row) * image.width + left);
            faces.row(face, row).copy_from_slice(&image.data[from..from + 3 * width]);
        }
        faces.loaded[face] = true;
    }
    Ok(faces.finish(source, colorspace))
}

fn cube_from_six(source: &TextureSource) -> Result<CompiledTexture, AssetError> {
    three_channels(source)?;
    let mut colorspace = source.colorspace;
    let mut faces: Option<Faces> = None;
    for (face, file) in source.cubefiles.iter().enumerate() {
        let Some(file) = file else { continue };
        let image = load(source, file)?;
        colorspace = resolve(colorspace, image.srgb);
        if image.width != image.height {
            return Err(AssetError::inconsistent(format!("cube face '{}' is not square", file.path)));
        }
        let faces = match &mut faces {
            Some(faces) if faces.width != image.width => {
                return Err(AssetError::inconsistent(format!("cube face '{}' differs in size", file.path)));
            }
            Some(faces) => faces,
            empty => empty.insert(Faces::new(source, image.width)?),
        };
        for (row, pixels) in image.data.chunks_exact(3 * image.width).enumerate() {
            faces.row(face, row).copy_from_slice(pixels);
        }
        faces.loaded[face] = true;
    }
    match faces {
        Some(faces) => Ok(faces.finish(source, colorspace)),
        None => {
            Err(AssetError::inconsistent(format!("texture '{}' has no builtin and no file", source.name)))
        }
    }
}

/// Six square images, one below the other.
struct Faces {
    width: usize,
    data: Vec<u8>,
    loaded: [bool; 6],
}

impl Faces {
    fn new(source: &TextureSource, width: usize) -> Result<Self, AssetError> {
        let bytes = byte_count(source, width, width.saturating_mul(6), 3)?;
        Ok(Self { width, data: vec![0; bytes], loaded: [false; 6] })
    }

    fn row(&mut self, face: usize, row: usize) -> &mut [u8] {
        let start = 3 * self.width * (face * self.width + row);
        &mut self.data[start..start + 3 * self.width]
    }

    /// Faces without image get the first colour.
    fn finish(mut self, source: &TextureSource, colorspace: ColorSpace) -> CompiledTexture {
        let blank = source.rgb1.map(|x| (255.0 * x) as u8);
        let size = 3 * self.width * self.width;
        for (face, pixels) in self.data.chunks_exact_mut(size).enumerate() {
            if !self.loaded[face] {
                pixels.chunks_exact_mut(3).for_each(|p| p.copy_from_slice(&blank));
            }
        }
        CompiledTexture {
            width: self.width,
            height: 6 * self.width,
            nchannel: 3,
            colorspace,
            data: self.data,
        }
    }
}

fn three_channels(source: &TextureSource) -> Result<(), AssetError> {
    if source.nchannel == 3 {
        return Ok(());
    }
    Err(AssetError::unsupported(format!(
        "texture '{}': {} channels in a cube or builtin texture",
        source.name, source.nchannel
    )))
}

fn byte_count(
    source: &TextureSource,
    width: usize,
    height: usize,
    channels: usize,
) -> Result<usize, AssetError> {
    width
        .checked_mul(height)
        .and_then(|n| n.checked_mul(channels))
        .filter(|&n| n > 0 && n <= MAX_BYTES)
        .ok_or_else(|| {
            AssetError::inconsistent(format!(
                "texture '{}': {width}x{height} pixels are too many",
                source.name
            ))
        })
}

fn resolve(colorspace: ColorSpace, srgb: bool) -> ColorSpace {
    match (colorspace, srgb) {
        (ColorSpace::Auto, true) => ColorSpace::Srgb,
        (ColorSpace::Auto, false) => ColorSpace::Linear,
        (given, _) => given,
    }
}

/// What a file holds: as the element says, else by its extension.
fn content_type<'a>(source: &'a TextureSource, file: &FileImage) -> &'a str {
    let path = file.path.to_ascii_lowercase();
    match source.content_type.as_str() {
        "" if path.ends_with(".png") => PNG,
        "" if path.ends_with(".ktx") => KTX,
        given => given,
    }
}

fn load(source: &TextureSource, file: &FileImage) -> Result<Pixels, AssetError> {
    if content_type(source, file) != PNG {
        let message = format!("texture file '{}' is not PNG, nor KTX in a texture of type 2d", file.path);
        return Err(AssetError::unsupported(message));
    }
    let mut image = png::decode(&file.bytes, &file.path, source.nchannel)?;
    let stride = source.nchannel * image.width;
    if source.hflip {
        for row in image.data.chunks_exact_mut(stride) {
            for column in 0..image.width / 2 {
                for channel in 0..source.nchannel {
                    let mirror = source.nchannel * (image.width - 1 - column) + channel;
                    row.swap(source.nchannel * column + channel, mirror);
                }
            }
        }
    }
    if source.vflip {
        for row in 0..image.height / 2 {
            let (upper, lower) = image.data.split_at_mut((image.height - 1 - row) * stride);
            upper[row * stride..(row + 1) * stride].swap_with_slice(&mut lower[..stride]);
        }
    }
    Ok(image)
}
