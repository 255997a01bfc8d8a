//! Still pictures: 8-bit RGB and 16-bit depth as PNG (ISO/IEC 15948).

use std::io::{self, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Compression, EncodingError};

use crate::error::VideoError;
use crate::frame::{Frame, check_length};
use crate::unfinished::write_whole;

/// Writes an 8-bit RGB PNG. A file of that name is replaced once the new one is complete.
pub fn write_png(path: impl AsRef<Path>, frame: &Frame<'_>) -> Result<(), VideoError> {
    write_whole(path.as_ref(), &png_bytes(frame))
}

/// The bytes of an 8-bit RGB PNG.
pub fn png_bytes(frame: &Frame<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode_png(&mut bytes, frame).expect("memory takes everything, and a frame is never empty");
    bytes
}

/// Writes an 8-bit RGB PNG to a writer.
pub fn encode_png(out: impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let size = (frame.width(), frame.height());
    encode(out, size, (ColorType::Rgb, BitDepth::Eight), frame.rgb()).map_err(into_io)
}

/// Writes depth as a 16-bit grey PNG in millimetres, the convention of depth cameras.
///
/// `depth` has `width * height` distances \[m\], rows from the top. A pixel is the distance rounded to a whole millimetre;
/// what is farther than 65.535 m, infinity included, is 65535; what is not a distance (negative or NaN) is 0.
pub fn write_depth_png(
    path: impl AsRef<Path>,
    width: u32,
    height: u32,
    depth: &[f32],
) -> Result<(), VideoError> {
    check_length("depth", width, height, depth.len())?;
    // A cast from float to integer saturates and takes NaN to 0.
    let big_endian: Vec<u8> =
        depth.iter().flat_map(|metres| ((metres * 1000.0).round() as u16).to_be_bytes()).collect();
    let mut bytes = Vec::new();
    encode(&mut bytes, (width, height), (ColorType::Grayscale, BitDepth::Sixteen), &big_endian)
        .expect("memory takes everything, and the length is checked");
    write_whole(path.as_ref(), &bytes)
}

/// Writes one picture.
fn encode(
    out: impl Write,
    (width, height): (u32, u32),
    (colour, depth): (ColorType, BitDepth),
    pixels: &[u8],
) -> Result<(), EncodingError> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_compression(Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()
}

fn into_io(error: EncodingError) -> io::Error {
    match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}
