//! What is done to the bytes of chunks: shuffle, deflate, Fletcher's checksum.

use super::bytes::Cursor;
use super::checksum::fletcher32;
use super::encode::DEFLATE_LEVEL;
use super::error::Decoded;
use flate2::{Compress, Compression, Decompress, FlushCompress, FlushDecompress, Status};

/// A step of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// Zlib's format.
    Deflate,
    /// Bytes of equal significance of elements of this many bytes, together.
    Shuffle(usize),
    /// A checksum behind the bytes.
    Fletcher32,
    /// What is not undone, by its number.
    Unknown(u64),
}

/// Deflate cannot make more of a byte than this.
pub const EXPANSION: u64 = 1032;

/// Decodes the body of a filters message.
///
/// # Errors
/// The body is cut off.
pub fn decode(body: &[u8]) -> Decoded<Vec<Filter>> {
    let mut at = Cursor(body);
    let (version, count) = (at.byte()?, at.byte()?);
    at.take(if version == 1 { 6 } else { 0 })?;
    let mut out = Vec::new();
    for _ in 0..count {
        let id = at.number(2)?;
        let name = if version == 1 || id >= 256 { at.short()? } else { 0 };
        at.short()?;
        let parameters = at.short()?;
        at.take(if version == 1 { name.next_multiple_of(8) } else { name })?;
        let parameters = at.take(4 * parameters)?;
        at.take(if version == 1 { parameters.len() % 8 } else { 0 })?;
        out.push(match id {
            1 => Filter::Deflate,
            2 => Filter::Shuffle(Cursor(parameters).number(4)? as usize),
            3 => Filter::Fletcher32,
            other => Filter::Unknown(other),
        });
    }
    Ok(out)
}

/// Undoes the filters, whose result must have `expected` bytes; those that have a bit in `skipped` were not applied.
///
/// # Errors
/// The bytes are damaged, or a filter is not known.
pub fn undo(filters: &[Filter], skipped: u64, stored: Vec<u8>, expected: u64) -> Decoded<Vec<u8>> {
    let mut bytes = stored;
    for (i, filter) in filters.iter().enumerate().rev().filter(|(i, _)| skipped >> (*i).min(63) & 1 == 0) {
        bytes = match *filter {
            Filter::Deflate => inflate(&bytes, expected, filters[..i].contains(&Filter::Fletcher32))?,
            Filter::Shuffle(element) => unshuffle(&bytes, element),
            Filter::Fletcher32 => {
                let (body, sum) = bytes.split_last_chunk::<4>().ok_or("a chunk is cut off")?;
                if fletcher32(body) != u32::from_le_bytes(*sum) {
                    return Err("the checksum of a chunk is wrong: the file is damaged".into());
                }
                body.to_vec()
            }
            Filter::Unknown(id) => return Err(unknown(id)),
        };
    }
    if bytes.len() as u64 != expected {
        let found = bytes.len();
        return Err(format!(
            "a chunk has {found} bytes where its shape needs {expected}: the file is damaged"
        ));
    }
    Ok(bytes)
}

fn unknown(id: u64) -> String {
    let name = match id {
        4 => "szip, ",
        5 => "nbit, ",
        6 => "scaleoffset, ",
        32000 => "lzf, ",
        _ => "",
    };
    format!(
        "chunks are compressed with filter {id} ({name}not read; gzip is): write the file with compression=\"gzip\""
    )
}

fn inflate(bytes: &[u8], expected: u64, summed: bool) -> Decoded<Vec<u8>> {
    let expected = expected + if summed { 4 } else { 0 };
    if expected > EXPANSION * (bytes.len() as u64 + 16) {
        return Err("a chunk is smaller than its shape allows: the file is damaged".into());
    }
    // One byte more shows whether there is more.
    let mut out = Vec::with_capacity(expected as usize + 1);
    let status = Decompress::new(true).decompress_vec(bytes, &mut out, FlushDecompress::Finish);
    match status {
        Ok(Status::StreamEnd) => Ok(out),
        Ok(_) => Err("a chunk's compressed bytes do not end: the file is damaged".into()),
        Err(error) => Err(format!("a chunk's compressed bytes are damaged: {error}")),
    }
}

fn unshuffle(bytes: &[u8], element: usize) -> Vec<u8> {
    let count = bytes.len() / element.max(1);
    let mut out = bytes.to_vec();
    for byte in 0..element {
        for i in 0..count {
            out[i * element + byte] = bytes[byte * count + i];
        }
    }
    out
}

/// Puts bytes of equal significance together, in `out`.
fn shuffle<'a>(bytes: &[u8], element: usize, out: &'a mut Vec<u8>) -> &'a [u8] {
    out.clear();
    for byte in 0..element {
        out.extend(bytes.iter().skip(byte).step_by(element));
    }
    out
}

/// Compresses chunks, in memory that is used again.
pub struct Packer {
    deflate: Compress,
    shuffled: Vec<u8>,
    packed: Vec<u8>,
}

impl Default for Packer {
    fn default() -> Self {
        let deflate = Compress::new(Compression::new(DEFLATE_LEVEL), true);
        Packer { deflate, shuffled: Vec::new(), packed: Vec::new() }
    }
}

impl Packer {
    /// Shuffles elements of `element` bytes, and deflates.
    ///
    /// # Errors
    /// The compressor fails.
    pub fn pack(&mut self, bytes: &[u8], element: usize) -> std::io::Result<&[u8]> {
        let shuffled = if element == 1 { bytes } else { shuffle(bytes, element, &mut self.shuffled) };
        self.deflate.reset();
        self.packed.clear();
        // Stored blocks: five bytes each, of at least 16 KiB; and zlib's frame.
        self.packed.reserve(bytes.len() + bytes.len() / 1024 + 64);
        let status = self.deflate.compress_vec(shuffled, &mut self.packed, FlushCompress::Finish)?;
        match status {
            Status::StreamEnd => Ok(&self.packed),
            _ => Err(std::io::Error::other("a chunk does not compress into the room that it needs at most")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIPELINE: [Filter; 2] = [Filter::Shuffle(8), Filter::Deflate];

    fn noise(count: usize) -> Vec<u8> {
        let mut x = 1u32;
        let mut next = || {
            x = x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (x >> 24) as u8
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn chunks_come_back_whatever_is_in_them() {
        let mut packer = Packer::default();
        for bytes in [noise(8), noise(1 << 20), vec![0; 1 << 20], vec![7; 24]] {
            let packed = packer.pack(&bytes, 8).unwrap().to_vec();
            assert!(undo(&PIPELINE, 0, packed, bytes.len() as u64).unwrap() == bytes);
        }
    }

    #[test]
    fn damage_is_told() {
        let mut packer = Packer::default();
        let packed = packer.pack(&noise(4096), 8).unwrap().to_vec();
        let wrong = |bytes: Vec<u8>, expected| undo(&PIPELINE, 0, bytes, expected).unwrap_err();
        assert!(wrong(packed.clone(), 4088).contains("do not end"));
        assert!(wrong(packed.clone(), 4104).contains("4096 bytes where its shape needs 4104"));
        assert!(wrong(packed[..2000].to_vec(), 4096).contains("do not end"));
        assert!(wrong(packed, 1 << 40).contains("smaller than its shape"));
        assert!(undo(&[Filter::Unknown(32000)], 0, vec![0], 1).unwrap_err().contains("lzf"));
    }

    #[test]
    fn a_filter_that_was_skipped_is_not_undone() {
        assert_eq!(undo(&PIPELINE, 3, vec![1, 2, 3], 3), Ok(vec![1, 2, 3]));
    }
}
