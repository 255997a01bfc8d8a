//! MuJoCo's legacy binary mesh: four counts (vertices, normals, texture coordinates, faces), then the
//! arrays as 32-bit floats and integers (MuJoCo XML reference, `asset/mesh`, MSH file format).

use super::source::{Format, RawMesh};
use crate::asset::AssetError;

const HEADER: usize = 16;

pub(super) fn decode(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    if bytes.len() < HEADER {
        return Err(AssetError::truncated(format!("MSH file '{path}' has no complete header")));
    }
    let count = |k: usize| i64::from(i32::from_le_bytes(bytes.as_chunks::<4>().0[k]));
    let [nvert, nnormal, ntexcoord, nface] = [count(0), count(1), count(2), count(3)];
    let per_vertex = |n: i64| n == 0 || n == nvert;
    if nvert < 4 || nface < 0 || !per_vertex(nnormal) || !per_vertex(ntexcoord) {
        return Err(AssetError::malformed(format!(
            "MSH file '{path}' has invalid counts: {nvert} vertices, {nnormal} normals, \
             {ntexcoord} texture coordinates, {nface} faces"
        )));
    }
    // Counts are below 2^31, so the sum cannot overflow 64 bits.
    let expected = HEADER as i64 + 4 * (3 * nvert + 3 * nnormal + 2 * ntexcoord + 3 * nface);
    if expected != bytes.len() as i64 {
        return Err(AssetError::truncated(format!(
            "MSH file '{path}' has {} bytes; its counts ask for {expected}",
            bytes.len()
        )));
    }
    let mut words = bytes[HEADER..].as_chunks::<4>().0.iter().copied();
    let mut floats =
        |n: i64| -> Vec<f32> { words.by_ref().take(n as usize).map(f32::from_le_bytes).collect() };
    let vert = floats(3 * nvert);
    let normal = floats(3 * nnormal);
    let texcoord = floats(2 * ntexcoord);
    let face: Vec<i32> = words.map(i32::from_le_bytes).collect();
    let facetexcoord = if texcoord.is_empty() { Vec::new() } else { face.clone() };
    Ok(RawMesh {
        format: Format::Msh,
        vert,
        normal,
        texcoord,
        facenormal: face.clone(),
        face,
        facetexcoord,
        line: Vec::new(),
    })
}
