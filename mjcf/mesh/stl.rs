//! Stereolithography files: triangles without shared vertices. Binary ones are told from text by their
//! size, since exporters write "solid" into binary headers too.

use std::collections::HashMap;

use super::decode::{Format, RawMesh, word};
use crate::asset::AssetError;

const HEADER: usize = 84;
const RECORD: usize = 50;
/// MuJoCo's limit on the faces of one file.
const MAX_FACES: usize = 200_000;
/// MuJoCo's limit on a coordinate, 2³⁰.
const MAX_COORDINATE: f32 = 1_073_741_824.0;

pub(super) fn decode(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    if bytes.is_empty() {
        return Err(AssetError::truncated(format!("STL file '{path}' is empty")));
    }
    let announced =
        if bytes.len() < HEADER { None } else { Some(u32::from_le_bytes(word(bytes, 80)) as usize) };
    match announced {
        Some(faces) if bytes.len() == HEADER + RECORD * faces => binary(bytes, faces, path),
        _ if bytes.trim_ascii_start().starts_with(b"solid") => text(bytes, path),
        Some(faces) => Err(AssetError::truncated(format!(
            "STL file '{path}' announces {faces} faces and has {} bytes instead of {}",
            bytes.len(),
            HEADER + RECORD * faces
        ))),
        None => Err(AssetError::truncated(format!("STL file '{path}' has no complete header"))),
    }
}

fn binary(bytes: &[u8], faces: usize, path: &str) -> Result<RawMesh, AssetError> {
    check_face_count(faces, path)?;
    let mut welded = Welded::with_capacity(3 * faces);
    for record in bytes[HEADER..].chunks_exact(RECORD) {
        for corner in 1..4 {
            let at = |k: usize| f32::from_le_bytes(word(record, 12 * corner + 4 * k));
            welded.push([at(0), at(1), at(2)], path)?;
        }
    }
    Ok(welded.finish())
}

/// Text form: every `vertex x y z` of every facet, in order.
fn text(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| AssetError::malformed(format!("STL file '{path}' is neither binary nor text")))?;
    let mut words = text.split_ascii_whitespace();
    let mut welded = Welded::with_capacity(0);
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case("vertex") {
            continue;
        }
        let mut vertex = [0.0; 3];
        for x in &mut vertex {
            let number = words.next().unwrap_or_default();
            *x = number.parse().map_err(|_| {
                AssetError::malformed(format!("STL file '{path}': '{number}' is not a coordinate"))
            })?;
        }
        welded.push(vertex, path)?;
    }
    if !welded.face.len().is_multiple_of(3) {
        return Err(AssetError::truncated(format!("STL file '{path}' ends inside a facet")));
    }
    check_face_count(welded.face.len() / 3, path)?;
    Ok(welded.finish())
}

fn check_face_count(faces: usize, path: &str) -> Result<(), AssetError> {
    if faces == 0 || faces > MAX_FACES {
        return Err(AssetError::malformed(format!(
            "STL file '{path}' has {faces} faces; 1 to {MAX_FACES} are allowed"
        )));
    }
    Ok(())
}

/// Triangle corners with bitwise equal vertices merged, numbered by first appearance.
struct Welded {
    vert: Vec<f32>,
    face: Vec<i32>,
    seen: HashMap<[u32; 3], i32>,
}

impl Welded {
    fn with_capacity(corners: usize) -> Self {
        Self {
            vert: Vec::new(),
            face: Vec::with_capacity(corners),
            seen: HashMap::with_capacity(corners / 4),
        }
    }

    fn push(&mut self, v: [f32; 3], path: &str) -> Result<(), AssetError> {
        if !v.iter().all(|x| x.abs() <= MAX_COORDINATE) {
            return Err(AssetError::malformed(format!(
                "STL file '{path}' has a vertex that is not finite or beyond 2^30"
            )));
        }
        let next = (self.vert.len() / 3) as i32;
        let index = *self.seen.entry(v.map(f32::to_bits)).or_insert(next);
        if index == next {
            self.vert.extend(v);
        }
        self.face.push(index);
        Ok(())
    }

    fn finish(self) -> RawMesh {
        RawMesh { format: Format::Stl, vert: self.vert, face: self.face, ..RawMesh::default() }
    }
}
