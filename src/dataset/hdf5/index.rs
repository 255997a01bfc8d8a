//! Where the chunks of a dataset are.

use super::bytes::{Cursor, Source};
use super::checksum::lookup3;
use super::encode::{Stored, UNDEFINED};
use super::error::Decoded;
use super::group::{Room, TreeNode};

/// How chunks are found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Index {
    /// A tree of version 1.
    Tree(u64),
    /// One chunk, of this many compressed bytes.
    Single {
        /// Where it is.
        address: u64,
        /// Bytes, if filtered.
        bytes: Option<u64>,
        /// Filters that were skipped.
        skipped: u64,
    },
    /// One after another, uncompressed.
    Implicit(u64),
    /// An array, whose header is here.
    FixedArray(u64),
}

/// A chunk: its place in the grid of chunks, and in the file.
#[derive(Clone, Debug)]
pub struct Chunk {
    /// Number along each axis.
    pub place: Vec<u64>,
    /// Where its bytes are.
    pub stored: Stored,
    /// Filters that were skipped.
    pub skipped: u64,
}

/// What an index is asked for: the dataset's shape in chunks, the chunk's shape, and its bytes.
pub struct Grid<'a> {
    /// Chunks along each axis.
    pub counts: &'a [u64],
    /// Scalars along each axis of a chunk.
    pub chunk: &'a [u64],
    /// Bytes of a chunk that is not compressed.
    pub bytes: u64,
    /// True when chunks are filtered.
    pub filtered: bool,
}

/// All chunks that the index leads to.
///
/// # Errors
/// The file is damaged.
pub fn chunks(source: &Source, index: &Index, grid: &Grid) -> Decoded<Vec<Chunk>> {
    match *index {
        Index::Tree(address) => tree(source, address, grid),
        Index::Single { address, bytes, skipped } => {
            let stored = Stored { address, bytes: bytes.unwrap_or(grid.bytes) };
            Ok(vec![Chunk { place: vec![0; grid.counts.len()], stored, skipped }])
        }
        Index::Implicit(address) => {
            let stored = |i: u64| Stored {
                address: address.saturating_add(i.saturating_mul(grid.bytes)),
                bytes: grid.bytes,
            };
            let count = total(source, grid)?;
            Ok((0..count).map(|i| Chunk { place: place(grid, i), stored: stored(i), skipped: 0 }).collect())
        }
        Index::FixedArray(address) => fixed_array(source, address, grid),
    }
}

/// Number of chunks; each takes at least a byte of the file.
fn total(source: &Source, grid: &Grid) -> Decoded<u64> {
    let count = grid.counts.iter().try_fold(1u64, |n, &count| n.checked_mul(count));
    count
        .filter(|&n| n <= source.length())
        .ok_or_else(|| "the shape has more chunks than the file has bytes: it is damaged".into())
}

/// Place of chunk `number`, counted in row-major order.
fn place(grid: &Grid, number: u64) -> Vec<u64> {
    let mut rest = number;
    let mut out = vec![0; grid.counts.len()];
    for (place, &count) in out.iter_mut().zip(grid.counts).rev() {
        *place = rest % count.max(1);
        rest /= count.max(1);
    }
    out
}

fn tree(source: &Source, root: u64, grid: &Grid) -> Decoded<Vec<Chunk>> {
    let mut out = Vec::new();
    if root == UNDEFINED {
        return Ok(out);
    }
    let mut room = Room::of(source);
    let mut nodes = vec![(root, None)];
    // Size, skipped filters, first scalar along each axis and inside of a scalar.
    let key = 8 + 8 * (grid.counts.len() + 1);
    while let Some((address, level)) = nodes.pop() {
        let node = TreeNode::read(source, address, level, key)?;
        room.spend(node.children.len() as u64)?;
        for child in &node.children {
            if node.level > 0 {
                nodes.push((child.address, Some(node.level - 1)));
                continue;
            }
            let mut at = Cursor(&child.key);
            let (bytes, skipped) = (at.number(4)?, at.number(4)?);
            let mut place = Vec::with_capacity(grid.chunk.len());
            for &length in grid.chunk {
                place.push(at.long()? / length.max(1));
            }
            out.push(Chunk { place, stored: Stored { address: child.address, bytes }, skipped });
        }
    }
    Ok(out)
}

fn fixed_array(source: &Source, address: u64, grid: &Grid) -> Decoded<Vec<Chunk>> {
    if address == UNDEFINED {
        return Ok(Vec::new());
    }
    let head = source.signed(b"FAHD", address, 28)?;
    let mut at = Cursor(&head);
    let (_version, filtered) = (at.byte()?, at.byte()? == 1);
    let (entry, page_bits) = (u64::from(at.byte()?), at.byte()?);
    let (count, block) = (at.long()?, at.long()?);
    let most = total(source, grid)?;
    // Behind the address of a filtered chunk: bytes of its size, at most eight, and four of the skipped filters.
    let right = if filtered { (13..=20).contains(&entry) } else { entry == 8 };
    if !right || filtered != grid.filtered || count < most || count > source.length() {
        return Err("the index of chunks does not fit the dataset: the file is damaged".into());
    }
    if block == UNDEFINED {
        return Ok(Vec::new());
    }
    let entries = entries(source, block, Table { count, entry, page_bits })?;
    let mut out = Vec::new();
    for (i, bytes) in entries.chunks_exact(entry as usize).enumerate().take(most as usize) {
        let mut at = Cursor(bytes);
        let address = at.long()?;
        let (bytes, skipped) =
            if filtered { (at.number(entry as usize - 12)?, at.number(4)?) } else { (grid.bytes, 0) };
        if address != UNDEFINED {
            out.push(Chunk { place: place(grid, i as u64), stored: Stored { address, bytes }, skipped });
        }
    }
    Ok(out)
}

/// Form of the elements of a fixed array.
struct Table {
    count: u64,
    entry: u64,
    page_bits: u8,
}

/// The entries of a fixed array's block, pages and checksums taken out.
fn entries(source: &Source, block: u64, table: Table) -> Decoded<Vec<u8>> {
    let Table { count, entry, page_bits } = table;
    let page = 1u64.checked_shl(page_bits.into()).unwrap_or(u64::MAX);
    // Signature, version, client, address of the header.
    const HEAD: u64 = 14;
    if count <= page {
        let all = source.signed(b"FADB", block, HEAD + count * entry + 4)?;
        let mut whole = b"FADB".to_vec();
        whole.extend(all);
        return Ok(checked(&whole)?[HEAD as usize..].to_vec());
    }
    // One bit for each page says whether it was ever written.
    let bitmap = count.div_ceil(page).div_ceil(8);
    let mut whole = b"FADB".to_vec();
    whole.extend(source.signed(b"FADB", block, HEAD + bitmap + 4)?);
    let written = checked(&whole)?[HEAD as usize..].to_vec();
    let mut out = Vec::new();
    let mut address = block + HEAD + bitmap + 4;
    for number in 0..count.div_ceil(page) {
        let bytes = page.min(count - number * page) * entry;
        if written[number as usize / 8] & (0x80 >> (number % 8)) == 0 {
            out.resize(out.len() + bytes as usize, u8::MAX);
        } else {
            out.extend(checked(&source.read(address, bytes + 4)?)?);
        }
        address += bytes + 4;
    }
    Ok(out)
}

/// The bytes before a right checksum.
fn checked(bytes: &[u8]) -> Decoded<&[u8]> {
    let (body, sum) = bytes.split_last_chunk::<4>().ok_or("an index of chunks is cut off")?;
    if lookup3(body) != u32::from_le_bytes(*sum) {
        return Err("the checksum of an index of chunks is wrong: the file is damaged".into());
    }
    Ok(body)
}
