//! Decodes the bytes of frames to colours and depths, and encodes the frames of simulated cameras.

use crate::port::{Encoding, Format};
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Decodes frames of one camera.
#[derive(Debug, Default)]
pub(super) struct Decoder {
    jpeg: Vec<u8>,
    decoded: Vec<u8>,
}

/// Start marker of a JPEG picture, and the segment that makes the decoder use the Huffman tables of ITU-T T.81,
/// annex K.3, where the picture has none.
const START: [u8; 2] = [0xff, 0xd8];
const USUAL_TABLES: [u8; 10] = *b"\xff\xe0\x00\x08AVI1\0\0";

impl Decoder {
    /// Fills `rgb` with the colours of a frame, `height * width * 3`.
    ///
    /// # Errors
    /// The frame is damaged; the message says how.
    pub(super) fn rgb(&mut self, format: Format, bytes: &[u8], rgb: &mut Vec<u8>) -> Result<(), String> {
        match format.encoding {
            Encoding::Yuyv => pairs(format, bytes, [0, 2, 1, 3], rgb),
            Encoding::Uyvy => pairs(format, bytes, [1, 3, 0, 2], rgb),
            Encoding::Mjpg => self.jpeg(format, bytes, rgb),
            Encoding::Z16 => Err("it contains depth and no colours".to_owned()),
        }
    }

    fn jpeg(&mut self, format: Format, bytes: &[u8], rgb: &mut Vec<u8>) -> Result<(), String> {
        let Decoder { jpeg, decoded } = self;
        let picture =
            bytes.strip_prefix(&START).ok_or("it is damaged: it does not begin like a JPEG picture")?;
        jpeg.clear();
        for part in [&START[..], &USUAL_TABLES, picture] {
            jpeg.extend_from_slice(part);
        }
        let options = DecoderOptions::default()
            .set_max_width(format.width)
            .set_max_height(format.height)
            .jpeg_set_out_colorspace(ColorSpace::RGB);
        let mut decoder = JpegDecoder::new_with_options(Cursor::new(&*jpeg), options);
        let damaged = |error: DecodeErrors| format!("its JPEG picture is damaged: {error}");
        decoder.decode_headers().map_err(damaged)?;
        let (Some(size), Some(length)) = (decoder.dimensions(), decoder.output_buffer_size()) else {
            return Err("its JPEG picture has no size".to_owned());
        };
        if size != (format.width, format.height) {
            return Err(format!(
                "its JPEG picture has {} x {} pixels instead of {} x {}",
                size.0, size.1, format.width, format.height
            ));
        }
        decoded.resize(length, 0);
        decoder.decode_into(decoded).map_err(damaged)?;
        std::mem::swap(rgb, decoded);
        Ok(())
    }
}

/// The bytes of all pixels, 2 for each.
///
/// # Errors
/// The frame is shorter.
fn whole(format: Format, bytes: &[u8]) -> Result<&[u8], String> {
    let expected = 2 * format.width * format.height;
    bytes.get(..expected).ok_or_else(|| format!("it has {} bytes instead of {expected}", bytes.len()))
}

/// Converts pairs of pixels from YCbCr (ITU-R BT.601 with luma from 16 to 235, as USB cameras send it) to RGB. The list has the
/// indices of first luma, second luma, Cb and Cr among the four bytes of a pair.
fn pairs(
    format: Format,
    bytes: &[u8],
    [first, second, blue, red]: [usize; 4],
    rgb: &mut Vec<u8>,
) -> Result<(), String> {
    rgb.clear();
    for pair in whole(format, bytes)?.chunks_exact(4) {
        let [blue, red] = [blue, red].map(|place| i32::from(pair[place]) - 128);
        for place in [first, second] {
            let brightness = 298 * (i32::from(pair[place]) - 16) + 128;
            let colours = [409 * red, -208 * red - 100 * blue, 516 * blue];
            rgb.extend(colours.map(|colour| ((brightness + colour) >> 8).clamp(0, 255) as u8));
        }
    }
    Ok(())
}

/// Fills `depths` with the depths of a frame \[m\], whose unit is `unit` \[m\].
///
/// # Errors
/// The frame is damaged; the message says how.
pub(super) fn depth(format: Format, bytes: &[u8], unit: f64, depths: &mut Vec<f32>) -> Result<(), String> {
    let steps = whole(format, bytes)?.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
    depths.clear();
    depths.extend(steps.map(|step| (f64::from(step) * unit) as f32));
    Ok(())
}

/// Encodes colours, `height * width * 3`, as a frame of [`Encoding::Yuyv`]; two neighbouring pixels share their chroma.
pub fn rgb_to_yuyv(rgb: &[u8], frame: &mut Vec<u8>) {
    frame.clear();
    for pair in rgb.chunks_exact(6) {
        let colours = [0, 1, 2].map(|k| [0, 3].map(|pixel| i32::from(pair[pixel + k])));
        let [red, green, blue] = colours;
        let brightness = [0, 1].map(|k| ((66 * red[k] + 129 * green[k] + 25 * blue[k] + 128) >> 8) + 16);
        let [red, green, blue] = colours.map(|[first, second]| (first + second) / 2);
        let blueness = ((-38 * red - 74 * green + 112 * blue + 128) >> 8) + 128;
        let redness = ((112 * red - 94 * green - 18 * blue + 128) >> 8) + 128;
        frame.extend([brightness[0], blueness, brightness[1], redness].map(|byte| byte as u8));
    }
}

/// Encodes depths \[m\] as a frame of [`Encoding::Z16`] with the unit `unit` \[m\]; 0, no depth, beyond 65,535 units.
pub fn depth_to_z16(depths: &[f32], unit: f64, frame: &mut Vec<u8>) {
    frame.clear();
    for depth in depths {
        let steps = (f64::from(*depth) / unit).round();
        let step = if steps <= f64::from(u16::MAX) { steps as u16 } else { 0 };
        frame.extend(step.to_le_bytes());
    }
}
