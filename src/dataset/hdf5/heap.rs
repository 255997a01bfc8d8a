//! Heaps: names of old groups, and texts of any length.

use super::bytes::{Cursor, Source};
use super::encode::MAX_NAME;
use super::error::Decoded;
use std::collections::HashMap;

/// The bytes that the local heap at `address` holds.
///
/// # Errors
/// There is no heap.
pub fn local(source: &Source, address: u64) -> Decoded<Vec<u8>> {
    let header = source.signed(b"HEAP", address, 32)?;
    let mut at = Cursor(&header);
    at.take(4)?;
    let bytes = at.long()?;
    at.long()?;
    source.read(at.long()?, bytes)
}

/// The name that begins at `offset` of a local heap.
///
/// # Errors
/// The offset leads out of it.
pub fn name(heap: &[u8], offset: u64) -> Decoded<String> {
    let start = usize::try_from(offset).ok().and_then(|offset| heap.get(offset..));
    let start = start.ok_or("a name lies outside of its heap: the file is damaged")?;
    let end = start.iter().take(MAX_NAME + 1).position(|&b| b == 0);
    let end = end.ok_or("a name has no end: the file is damaged")?;
    Ok(String::from_utf8_lossy(&start[..end]).into_owned())
}

/// The bytes of every object of the global heap at `address`, by its index.
///
/// # Errors
/// There is no heap.
pub fn global(source: &Source, address: u64) -> Decoded<HashMap<u64, Vec<u8>>> {
    let header = source.signed(b"GCOL", address, 16)?;
    let mut at = Cursor(&header);
    at.take(4)?;
    let bytes = at.long()?;
    let heap = source.read(address, bytes)?;
    let mut at =
        Cursor(heap.get(16..).ok_or("a heap of texts is shorter than its own header: the file is damaged")?);
    let mut out = HashMap::new();
    while at.0.len() >= 16 {
        let index = at.number(2)?;
        at.take(6)?;
        let bytes = usize::try_from(at.long()?).map_err(|e| e.to_string())?;
        if index == 0 {
            break;
        }
        let padded = at.take(bytes.checked_next_multiple_of(8).unwrap_or(usize::MAX))?;
        out.insert(index, padded[..bytes].to_vec());
    }
    Ok(out)
}
