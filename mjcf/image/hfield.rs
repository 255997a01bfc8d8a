//! Height fields: a grid of elevations scaled to \[0, 1\].

use super::png;
use crate::asset::AssetError;

/// What an `asset/hfield` element says, with its file already read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HfieldSource {
    /// Name for messages.
    pub name: String,
    /// File bytes and path.
    pub file: Option<(Vec<u8>, String)>,
    /// Attribute `content_type`, empty to go by the file's extension.
    pub content_type: String,
    /// Rows of the grid; 0 with a file.
    pub nrow: usize,
    /// Columns of the grid; 0 with a file.
    pub ncol: usize,
    /// Attribute `elevation` in storage order: the XML gives the rows top down, storage starts with
    /// the row of smallest y, so the reader reverses them.
    pub elevation: Vec<f32>,
    /// Half extent x, half extent y, height of elevation 1, depth of the base; metres.
    pub size: [f64; 4],
}

/// The rows one height field contributes to a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CompiledHfield {
    /// `hfield_nrow`.
    pub nrow: usize,
    /// `hfield_ncol`.
    pub ncol: usize,
    /// `hfield_size`.
    pub size: [f64; 4],
    /// `hfield_data`: row-major, first row at smallest y.
    pub data: Vec<f32>,
}

/// Compiles one height field.
pub fn hfield(source: HfieldSource) -> Result<CompiledHfield, AssetError> {
    let HfieldSource { name, file, content_type, nrow, ncol, elevation, size } = source;
    if size.iter().any(|&s| s.is_nan() || s <= 0.0) {
        return Err(AssetError::inconsistent(format!("hfield '{name}': sizes must be positive")));
    }
    let (nrow, ncol, mut data) = match file {
        Some(_) if nrow != 0 || ncol != 0 || !elevation.is_empty() => {
            return Err(AssetError::inconsistent(format!("hfield '{name}' has both a file and inline data")));
        }
        Some((bytes, path)) => read(&bytes, &path, &content_type)?,
        None if elevation.is_empty() && nrow.saturating_mul(ncol) <= MAX_CELLS => {
            (nrow, ncol, vec![0.0; nrow * ncol])
        }
        None => (nrow, ncol, elevation),
    };
    if nrow == 0 || ncol == 0 || nrow.checked_mul(ncol) != Some(data.len()) {
        return Err(AssetError::inconsistent(format!(
            "hfield '{name}': {} elevations for {nrow} rows and {ncol} columns",
            data.len()
        )));
    }
    if data.iter().any(|x| !x.is_finite()) {
        return Err(AssetError::geometry(format!("hfield '{name}' has an elevation that is not finite")));
    }
    to_unit_range(&mut data);
    Ok(CompiledHfield { nrow, ncol, size, data })
}

/// Largest grid without data: places in the model's array are 32-bit integers.
const MAX_CELLS: usize = i32::MAX as usize;

fn read(bytes: &[u8], path: &str, content_type: &str) -> Result<(usize, usize, Vec<f32>), AssetError> {
    let png = match content_type {
        "" => path.to_ascii_lowercase().ends_with(".png"),
        "image/png" => true,
        "image/vnd.mujoco.hfield" => false,
        other => return Err(AssetError::unsupported(format!("hfield content type '{other}' of '{path}'"))),
    };
    if png { from_png(bytes, path) } else { from_binary(bytes, path) }
}

/// Brightness is elevation; images are stored top down, height fields bottom up.
fn from_png(bytes: &[u8], path: &str) -> Result<(usize, usize, Vec<f32>), AssetError> {
    let image = png::decode(bytes, path, 1)?;
    let data = image.data.chunks_exact(image.width).rev().flatten().map(|&x| f32::from(x)).collect();
    Ok((image.height, image.width, data))
}

/// MuJoCo's own format: rows, columns, then 32-bit floats.
fn from_binary(bytes: &[u8], path: &str) -> Result<(usize, usize, Vec<f32>), AssetError> {
    let Some((header, body)) = bytes.split_at_checked(8) else {
        return Err(AssetError::truncated(format!("hfield file '{path}' has no complete header")));
    };
    let count = |at: usize| i32::from_le_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]);
    let (nrow, ncol) = (count(0), count(4));
    if nrow < 1 || ncol < 1 {
        return Err(AssetError::malformed(format!(
            "hfield file '{path}' has {nrow} rows and {ncol} columns"
        )));
    }
    if 4 * i128::from(nrow) * i128::from(ncol) != body.len() as i128 {
        return Err(AssetError::truncated(format!(
            "hfield file '{path}' announces {nrow}x{ncol} elevations and has {} bytes of them",
            body.len()
        )));
    }
    let data = body.chunks_exact(4).map(|w| f32::from_le_bytes([w[0], w[1], w[2], w[3]])).collect();
    Ok((nrow as usize, ncol as usize, data))
}

/// Subtracts the minimum and divides by the range, unless the field is flat.
fn to_unit_range(data: &mut [f32]) {
    let (mut least, mut most) = (1e10f32, -1e10f32);
    for &x in &*data {
        least = least.min(x);
        most = most.max(x);
    }
    let range = most - least;
    for x in data {
        *x -= least;
        if f64::from(range) > 1e-14 {
            *x /= range;
        }
    }
}
