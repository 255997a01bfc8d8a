//! Meshes of GMSH, format 2.2 and 4.1, text and binary: nodes, and elements of one type.
//!
//! Counts are taken for what they announce only after the bytes that they need are known to be there.

mod binary;
mod cursor;
mod section;
mod text;

use super::cloud::Cloud;
use crate::asset::AssetError;
use section::Section;

/// What every file begins with.
const MARK: &[u8] = b"$MeshFormat";

/// Bytes of a coordinate.
const REAL: f64 = 8.0;

/// Layout of the sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    V22,
    V41,
}

/// Reads a file. `path` appears in messages.
///
/// # Errors
/// The file is no GMSH mesh of a version that is read, is damaged, or has elements that are not lines, triangles or
/// tetrahedra, all of one type.
pub fn decode(bytes: &[u8], path: &str) -> Result<Cloud, AssetError> {
    let (version, binary) = header(bytes, path)?;
    let nodes = section(bytes, path, "Nodes")?;
    let elements = section(bytes, path, "Elements")?;
    let cloud = match (version, binary) {
        (Version::V22, false) => text::read_v22(&nodes, &elements)?,
        (Version::V22, true) => binary::read_v22(&nodes, &elements)?,
        (Version::V41, false) => text::read_v41(&nodes, &elements)?,
        (Version::V41, true) => binary::read_v41(&nodes, &elements)?,
    };
    match cloud.point.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(nodes.malformed(format!("node {} is not finite", at / 3 + 1))),
        None => Ok(cloud),
    }
}

/// Version, and whether numbers are binary.
fn header(bytes: &[u8], path: &str) -> Result<(Version, bool), AssetError> {
    let refuse = |why: &str| AssetError::malformed(format!("GMSH file '{path}' {why}")).on_line(1);
    let rest = bytes.strip_prefix(MARK).ok_or_else(|| refuse("does not begin with $MeshFormat"))?;
    let line = &rest[..rest.len().min(64)];
    let line = String::from_utf8_lossy(line);
    let mut words = line.split_ascii_whitespace();
    let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
    let (Some(version), Some(binary)) = (number(), number()) else {
        return Err(refuse("has no version after $MeshFormat"));
    };
    if number() != Some(REAL) {
        return Err(refuse(
            "does not say that its numbers have 8 bytes: write 8 behind version and file type",
        ));
    }
    let version = match (100.0 * version).round() {
        220.0 => Version::V22,
        410.0 => Version::V41,
        _ => {
            return Err(AssetError::unsupported(format!(
                "GMSH file '{path}' has format {version}: save it in format 4.1 or 2.2"
            )));
        }
    };
    Ok((version, binary != 0.0))
}

/// What stands between `$name` and `$Endname`, without the line break after the first.
fn section<'a>(bytes: &'a [u8], path: &'a str, name: &'static str) -> Result<Section<'a>, AssetError> {
    let (begin, end) = (format!("${name}"), format!("$End{name}"));
    let missing = |what: &str| AssetError::malformed(format!("GMSH file '{path}' has no {what}"));
    let from = find(bytes, begin.as_bytes()).ok_or_else(|| missing(&begin))? + begin.len();
    let to = from
        + find(&bytes[from..], end.as_bytes()).ok_or_else(|| missing(&format!("{end} after {begin}")))?;
    let line = 2 + bytes[..from].iter().filter(|&&b| b == b'\n').count();
    let inside = &bytes[from..to];
    let inside = inside.strip_prefix(b"\r").unwrap_or(inside);
    let inside = inside.strip_prefix(b"\n").unwrap_or(inside);
    Ok(Section { bytes: inside, line, path, name })
}

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|window| window == what)
}
