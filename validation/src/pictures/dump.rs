//! Pictures to look at: ours, the recorded one, and their difference.

use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::path::Path;

/// Factor of the shown difference.
const GAIN: u8 = 8;

/// Writes `FOLDER/NAME.png`: our square picture, the recorded one, and `GAIN` times their absolute difference.
///
/// # Errors
/// The file cannot be written.
pub fn side_by_side(
    folder: &Path,
    name: &str,
    side: usize,
    ours: &[u8],
    recorded: &[u8],
) -> Result<(), String> {
    let difference: Vec<u8> =
        ours.iter().zip(recorded).map(|(a, b)| a.abs_diff(*b).saturating_mul(GAIN)).collect();
    let rows = [ours, recorded, &difference].map(|picture| picture.chunks(3 * side));
    let [ours, recorded, difference] = rows;
    let pixels: Vec<u8> =
        ours.zip(recorded).zip(difference).flat_map(|((a, b), c)| [a, b, c].concat()).collect();
    let path = folder.join(format!("{name}.png"));
    let error = |message: String| format!("{}: {message}", path.display());
    create_dir_all(folder).map_err(|e| error(e.to_string()))?;
    let file = BufWriter::new(File::create(&path).map_err(|e| error(e.to_string()))?);
    let mut encoder = png::Encoder::new(file, 3 * side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|e| error(e.to_string()))?;
    writer.write_image_data(&pixels).map_err(|e| error(e.to_string()))
}

/// A colour for every object: black for none, else bits of a hash of its number and type.
pub fn false_colours(ids: &[[i32; 2]]) -> Vec<u8> {
    let colour = |[number, kind]: [i32; 2]| {
        if number < 0 {
            return [0; 3];
        }
        let hash = (number as u32).wrapping_mul(64).wrapping_add(kind as u32).wrapping_mul(0x9e37_79b9);
        [hash >> 24, hash >> 16, hash >> 8].map(|bits| (bits & 0xff) as u8 | 0x20)
    };
    ids.iter().flat_map(|id| colour(*id)).collect()
}
