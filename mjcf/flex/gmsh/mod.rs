//! Meshes of GMSH, format 2.2 and 4.1, text and binary: nodes, and elements of one type.
//!
//! Counts are taken for what they announce only after the bytes that they need are known to be there.

mod binary;
mod cursor;
mod text;

use super::Cloud;
use crate::asset::AssetError;

/// What every file begins with.
const MARK: &[u8] = b"$MeshFormat";

/// Most nodes or elements of a file.
const MOST: usize = i32::MAX as usize / 4;

/// Layout of the sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    V22,
    V41,
}

/// One part of a file, and where it begins.
#[derive(Clone, Copy)]
struct Section<'a> {
    bytes: &'a [u8],
    /// Line of the file that it begins on, from one.
    line: usize,
    path: &'a str,
    /// What messages call it.
    name: &'static str,
}

impl Section<'_> {
    fn malformed(&self, why: impl std::fmt::Display) -> AssetError {
        AssetError::malformed(format!("GMSH file '{}', section ${}: {why}", self.path, self.name))
            .on_line(self.line)
    }

    fn truncated(&self) -> AssetError {
        AssetError::truncated(format!("GMSH file '{}' ends inside of section ${}", self.path, self.name))
            .on_line(self.line)
    }
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

/// Vertices of an element less one, by GMSH's number of its type.
fn dimension(kind: i64, section: &Section<'_>) -> Result<i32, AssetError> {
    match kind {
        1 => Ok(1),
        2 => Ok(2),
        4 => Ok(3),
        _ => Err(section.malformed(format!(
            "elements of type {kind} are not read: save lines (1), triangles (2) or tetrahedra (4) of first order"
        ))),
    }
}

/// A count of nodes or elements. Each takes at least `bytes` bytes, so `left` bytes bound the count.
fn count(number: u64, bytes: usize, left: usize, section: &Section<'_>) -> Result<usize, AssetError> {
    let n = usize::try_from(number).ok().filter(|&n| n < MOST);
    let n = n.ok_or_else(|| section.malformed(format!("cannot hold {number} entries")))?;
    if n.checked_mul(bytes).is_some_and(|needed| needed <= left) {
        return Ok(n);
    }
    Err(section.truncated())
}

/// The head of a section in format 4.1, which has one block.
struct Head {
    count: usize,
    /// Number of the first entry.
    first: u64,
    dimension: i64,
    /// Type of the elements; means nothing for nodes.
    kind: i64,
}

/// Checks the eight numbers before the entries of a section: blocks, entries, first and last number, dimension, entity,
/// type, entries of the block.
fn head(numbers: [u64; 8], bytes: usize, left: usize, section: &Section<'_>) -> Result<Head, AssetError> {
    let [blocks, entries, first, _, dimension, _, kind, in_block] = numbers;
    if blocks != 1 || entries != in_block {
        return Err(section.malformed(
            "all entries must be in one block: keep one volume, surface or curve, and save its elements alone",
        ));
    }
    let count = count(entries, bytes, left, section)?;
    Ok(Head { count, first, dimension: dimension as i64, kind: kind as i64 })
}

/// The dimension of nodes and elements, which must be equal.
fn matching(nodes: &Head, elements: &Head, section: &Section<'_>) -> Result<i32, AssetError> {
    let dim = dimension(elements.kind, section)?;
    if nodes.dimension != elements.dimension || elements.dimension != i64::from(dim) {
        return Err(section.malformed(format!(
            "dimension {} of the nodes, {} of the elements and type {} do not fit each other",
            nodes.dimension, elements.dimension, elements.kind
        )));
    }
    Ok(dim)
}

/// Index of the node called `tag`.
fn node(tag: u64, first: u64, nodes: usize, section: &Section<'_>) -> Result<i32, AssetError> {
    match tag.checked_sub(first) {
        Some(index) if index < nodes as u64 => Ok(index as i32),
        _ => Err(section.malformed(format!("there is no node {tag}"))),
    }
}
