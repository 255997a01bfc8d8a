//! File bytes to raw mesh arrays: which reader, and what all of them return.

use super::source::{Format, RawMesh};
use super::{msh, obj, stl};
use crate::asset::AssetError;

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
