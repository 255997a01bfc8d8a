//! File bytes to raw mesh arrays: which reader, and what all of them return.

use super::{msh, obj, stl};
use crate::asset::AssetError;

/// Where the arrays of a [`RawMesh`] come from; the formats differ in how they are completed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Format {
    /// Attributes of the XML element.
    #[default]
    Inline,
    /// Stereolithography file.
    Stl,
    /// Wavefront file.
    Obj,
    /// MuJoCo's legacy binary file.
    Msh,
}

/// Arrays as a file or the XML gives them, before any processing; absent ones are empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RawMesh {
    /// Origin of the arrays.
    pub format: Format,
    /// Vertex coordinates, three per vertex.
    pub vert: Vec<f32>,
    /// Normal coordinates, three per normal.
    pub normal: Vec<f32>,
    /// Texture coordinates, two per entry, v downwards.
    pub texcoord: Vec<f32>,
    /// Vertex indices, three per triangle.
    pub face: Vec<i32>,
    /// Normal indices, three per triangle.
    pub facenormal: Vec<i32>,
    /// Texture coordinate indices, three per triangle.
    pub facetexcoord: Vec<i32>,
}

/// Reads a mesh file. `path` chooses the reader by its extension and appears in messages;
/// `content_type` (a MIME type such as `model/obj`), when not empty, chooses instead.
pub fn decode(bytes: &[u8], path: &str, content_type: &str) -> Result<RawMesh, AssetError> {
    match format_of(path, content_type) {
        Some(Format::Stl) => stl::decode(bytes, path),
        Some(Format::Obj) => obj::decode(bytes, path),
        Some(Format::Msh) => msh::decode(bytes, path),
        _ if content_type.is_empty() => {
            Err(AssetError::unsupported(format!("mesh file '{path}' is not .stl, .obj or .msh")))
        }
        _ => Err(AssetError::unsupported(format!("mesh content type '{content_type}' of '{path}'"))),
    }
}

fn format_of(path: &str, content_type: &str) -> Option<Format> {
    let mime = content_type.split(';').next().unwrap_or_default().trim();
    match mime {
        "model/stl" => return Some(Format::Stl),
        "model/obj" => return Some(Format::Obj),
        "model/vnd.mujoco.msh" => return Some(Format::Msh),
        "" => {}
        _ => return None,
    }
    let (_, extension) = path.rsplit_once('.')?;
    match extension.to_ascii_lowercase().as_str() {
        "stl" => Some(Format::Stl),
        "obj" => Some(Format::Obj),
        "msh" => Some(Format::Msh),
        _ => None,
    }
}

/// Little-endian 32-bit word at byte `at`; the caller has checked the length.
pub(super) fn word(bytes: &[u8], at: usize) -> [u8; 4] {
    [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]
}
