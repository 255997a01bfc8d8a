//! PNG files to 8-bit pixels with a chosen number of channels.

use ::png::{BitDepth, ColorType, Decoder, Limits, Transformations};

use crate::asset::AssetError;

/// Decoded pixels, row by row from the top.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Pixels {
    pub width: usize,
    pub height: usize,
    /// `width * height * channels` bytes.
    pub data: Vec<u8>,
    /// The file declares the sRGB colour space.
    pub srgb: bool,
}

/// Largest decoded image, so that a few bytes cannot ask for all memory.
const MAX_BYTES: usize = 1 << 30;

/// Decodes with 1 (grey, the red channel of coloured files), 3 or 4 channels. 16-bit samples keep
/// their high byte.
pub(super) fn decode(bytes: &[u8], path: &str, channels: usize) -> Result<Pixels, AssetError> {
    let fail = |why: String| AssetError::malformed(format!("PNG file '{path}': {why}"));
    if bytes.is_empty() {
        return Err(AssetError::truncated(format!("PNG file '{path}' is empty")));
    }
    let mut decoder = Decoder::new_with_limits(std::io::Cursor::new(bytes), Limits { bytes: MAX_BYTES });
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(|e| fail(e.to_string()))?;
    let info = reader.info();
    let (width, height, srgb) = (info.width as usize, info.height as usize, info.srgb.is_some());
    if info.palette.as_ref().is_some_and(|palette| !palette.len().is_multiple_of(3)) {
        return Err(fail("the palette ends inside a colour".into()));
    }
    let size = reader.output_buffer_size().filter(|&n| n <= MAX_BYTES);
    let size = size.ok_or_else(|| fail(format!("{width}x{height} pixels are too many")))?;
    // Deflate expands at most about a thousandfold; a larger claim is a lie.
    if size / 2048 > bytes.len() {
        return Err(AssetError::truncated(format!(
            "PNG file '{path}' announces {width}x{height} pixels in {} bytes",
            bytes.len()
        )));
    }
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(|e| fail(e.to_string()))?;
    if frame.bit_depth != BitDepth::Eight {
        return Err(fail(format!("unexpected depth {:?}", frame.bit_depth)));
    }
    data.truncate(frame.buffer_size());
    let data = convert(data, frame.color_type, channels).ok_or_else(|| fail("unexpected palette".into()))?;
    Ok(Pixels { width, height, data, srgb })
}

fn convert(data: Vec<u8>, from: ColorType, channels: usize) -> Option<Vec<u8>> {
    let samples = match from {
        ColorType::Indexed => return None,
        other => other.samples(),
    };
    if samples == channels {
        return Some(data);
    }
    let pixel = |p: &[u8]| -> [u8; 4] {
        match p {
            [grey] => [*grey, *grey, *grey, 255],
            [grey, alpha] => [*grey, *grey, *grey, *alpha],
            [r, g, b] => [*r, *g, *b, 255],
            _ => [p[0], p[1], p[2], p[3]],
        }
    };
    let mut out = Vec::with_capacity(data.len() / samples * channels);
    for p in data.chunks_exact(samples) {
        out.extend_from_slice(&pixel(p)[..channels]);
    }
    Some(out)
}
