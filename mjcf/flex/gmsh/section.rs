//! A section of a file: its bytes and its errors, and what is checked before its entries are read.

use crate::asset::AssetError;

/// Most nodes or elements of a file.
const MOST: usize = i32::MAX as usize / 4;

/// One part of a file, and where it begins.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    pub(super) bytes: &'a [u8],
    /// Line of the file that it begins on, from one.
    pub(super) line: usize,
    pub(super) path: &'a str,
    /// What messages call it.
    pub(super) name: &'static str,
}

impl Section<'_> {
    pub(super) fn malformed(&self, why: impl std::fmt::Display) -> AssetError {
        AssetError::malformed(format!("GMSH file '{}', section ${}: {why}", self.path, self.name))
            .on_line(self.line)
    }

    pub(super) fn truncated(&self) -> AssetError {
        AssetError::truncated(format!("GMSH file '{}' ends inside of section ${}", self.path, self.name))
            .on_line(self.line)
    }
}

/// Vertices of an element less one, by GMSH's number of its type.
pub(super) fn dimension(kind: i64, section: &Section<'_>) -> Result<i32, AssetError> {
    match kind {
        1 => Ok(1),
        2 => Ok(2),
        4 => Ok(3),
        _ => Err(section.malformed(format!(
            "elements of type {kind} are not read: save lines (1), triangles (2) or tetrahedra (4) of first order"
        ))),
    }
}

/// A count of nodes or elements. Each takes at least `bytes` of the bytes left.
pub(super) fn count(
    number: u64,
    bytes: usize,
    left: usize,
    section: &Section<'_>,
) -> Result<usize, AssetError> {
    let n = usize::try_from(number).ok().filter(|&n| n < MOST);
    let n = n.ok_or_else(|| section.malformed(format!("cannot hold {number} entries")))?;
    if n.checked_mul(bytes).is_some_and(|needed| needed <= left) {
        return Ok(n);
    }
    Err(section.truncated())
}

/// The head of a section in format 4.1, which has one block.
pub(super) struct Head {
    pub(super) count: usize,
    /// Number of the first entry.
    pub(super) first: u64,
    pub(super) dimension: i64,
    /// Type of the elements; means nothing for nodes.
    kind: i64,
}

/// Checks the eight numbers before the entries of a section: blocks, entries, first and last number, dimension, entity,
/// type, entries of the block.
pub(super) fn head(
    numbers: [u64; 8],
    bytes: usize,
    left: usize,
    section: &Section<'_>,
) -> Result<Head, AssetError> {
    let [blocks, entries, first, _, dimension, _, kind, in_block] = numbers;
    if blocks != 1 || entries != in_block {
        return Err(section.malformed(
            "all entries must be in one block: keep one volume, surface or curve, and save its elements alone",
        ));
    }
    let count = count(entries, bytes, left, section)?;
    Ok(Head { count, first, dimension: dimension as i64, kind: kind as i64 })
}

/// Nodes and elements have the same dimension.
pub(super) fn matching(nodes: &Head, elements: &Head, section: &Section<'_>) -> Result<i32, AssetError> {
    let dim = dimension(elements.kind, section)?;
    if nodes.dimension != elements.dimension || elements.dimension != i64::from(dim) {
        return Err(section.malformed(format!(
            "dimension {} of the nodes, {} of the elements and type {} do not fit each other",
            nodes.dimension, elements.dimension, elements.kind
        )));
    }
    Ok(dim)
}

/// Refuses a node of format 2.2 whose number is not its place, counted from one: elements name nodes by their place.
pub(super) fn in_order(tag: u64, place: usize, section: &Section<'_>) -> Result<(), AssetError> {
    let expected = place as u64 + 1;
    if tag == expected {
        return Ok(());
    }
    Err(section.malformed(format!("node {expected} is numbered {tag}: number nodes 1, 2, 3 ... in order")))
}

/// Refuses two elements of one number.
pub(super) fn distinct(mut tags: Vec<u64>, section: &Section<'_>) -> Result<(), AssetError> {
    tags.sort_unstable();
    match tags.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(()),
        Some(pair) => {
            Err(section.malformed(format!("two elements are numbered {}: number them apart", pair[0])))
        }
    }
}

/// Index of the node called `tag`.
pub(super) fn node(tag: u64, first: u64, nodes: usize, section: &Section<'_>) -> Result<i32, AssetError> {
    match tag.checked_sub(first) {
        Some(index) if index < nodes as u64 => Ok(index as i32),
        _ => Err(section.malformed(format!("there is no node {tag}"))),
    }
}
