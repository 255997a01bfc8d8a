//! Stereolithography files: triangles without shared vertices. Binary ones are told from text by their
//! size, since exporters write "solid" into binary headers too.

use std::collections::HashMap;

use super::source::{Format, RawMesh};
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
        bytes[..].get(80..).and_then(|rest| rest.first_chunk()).map(|&n| u32::from_le_bytes(n) as usize);
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
        // A normal, three corners, and two bytes of attributes.
        let (numbers, _) = record[12..48].as_chunks::<4>();
        for corner in numbers.as_chunks::<3>().0 {
            welded.push(corner.map(f32::from_le_bytes), path)?;
        }
    }
    Ok(welded.finish())
}

/// Text form: every `vertex x y z` of every facet, in order.
fn text(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| AssetError::malformed(format!("STL file '{path}' is neither binary nor text")))?;
    // Words are slices of the text, so their addresses tell where they stand.
    let line_of = |word: &str| {
        let offset = (word.as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
        1 + text.as_bytes()[..offset.min(text.len())].iter().filter(|&&byte| byte == b'\n').count()
    };
    let mut words = text.split_ascii_whitespace();
    let mut welded = Welded::with_capacity(0);
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case("vertex") {
            continue;
        }
        let mut vertex = [0.0; 3];
        for x in &mut vertex {
            let Some(number) = words.next() else {
                return Err(AssetError::truncated(format!("STL file '{path}' ends inside a vertex")));
            };
            *x = number.parse().map_err(|_| {
                let line = line_of(number);
                let message = format!("STL file '{path}', line {line}: '{number}' is not a coordinate");
                AssetError::malformed(message).on_line(line)
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
