//! Reading the content of a compiled model: scalars one after another, their checksum on the way.

use super::setting::Setting;
use crate::table::Field;
use std::io::{ErrorKind, Read};

/// Why the next scalars cannot be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReadError {
    /// The source of the bytes failed.
    Unreadable(ErrorKind),
    /// The content is shorter or longer than its header or its sizes say.
    Length,
    /// The setting of this name has an unknown code.
    Setting(&'static str),
}

/// Bytes of a word.
pub(crate) const WORD: usize = 8;

/// Digest of 64 bits: the sum of the digests of all words of eight bytes, each with its place, so that parts can be
/// read apart. That of a word is invertible, so bytes changed within one word always show.
pub fn checksum(bytes: &[u8]) -> u64 {
    sum(0, bytes)
}

/// The part of a digest that `bytes` from word `first` on make; zeros follow them.
pub(crate) fn sum(first: u64, bytes: &[u8]) -> u64 {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let term = |(place, word): (u64, u64)| {
        let h = (word ^ place.wrapping_mul(ODD)).wrapping_mul(ODD);
        h ^ (h >> 32)
    };
    let (words, rest) = bytes.as_chunks::<WORD>();
    let mut last = [0; WORD];
    last[..rest.len()].copy_from_slice(rest);
    let last = if rest.is_empty() { 0 } else { term((first + words.len() as u64, u64::from_le_bytes(last))) };
    let words = words.iter().map(|&word| u64::from_le_bytes(word));
    (first..).zip(words).map(term).fold(last, u64::wrapping_add)
}

/// Bytes read from the source at a time; whole words.
const BLOCK: usize = 1 << 16;

/// Reads scalars one after another.
pub(crate) struct Reader<'a> {
    source: &'a mut dyn Read,
    /// Room for a block behind what is left of another; `used..end` was read and not used.
    block: Vec<u8>,
    used: usize,
    end: usize,
    /// Bytes of the content, and how many of them the source still has for this reader.
    pub(crate) length: u64,
    unread: u64,
    /// Word of the content that the source comes to next.
    word: u64,
    pub(crate) digest: u64,
}

impl<'a> Reader<'a> {
    /// Reads `rest` bytes from byte `start` of the content on, a whole word.
    pub(crate) fn part(source: &'a mut dyn Read, start: u64, rest: u64) -> Self {
        let (block, word) = (vec![0; 2 * BLOCK], start / WORD as u64);
        Reader { source, block, used: 0, end: 0, length: start + rest, unread: rest, word, digest: 0 }
    }

    /// Leaves all from byte `start` of the content on, which was not yet read, to another; returns how many bytes.
    pub(crate) fn give(&mut self, start: u64) -> u64 {
        let rest = self.length - start;
        (self.length, self.unread) = (start, self.unread - rest);
        rest
    }

    /// Bytes of the content that were read and not used.
    pub(crate) fn ahead(&self) -> u64 {
        (self.end - self.used) as u64
    }

    /// Bytes of the content that were not used.
    pub(crate) fn left(&self) -> u64 {
        self.unread + self.ahead()
    }

    /// Makes the next `size` bytes available, fewer than a block.
    fn need(&mut self, size: usize) -> Result<(), ReadError> {
        if size as u64 > self.left() {
            return Err(ReadError::Length);
        }
        if self.end - self.used < size {
            self.next_block()?;
        }
        Ok(())
    }

    /// Reads a block behind the bytes that were not used.
    fn next_block(&mut self) -> Result<(), ReadError> {
        self.block.copy_within(self.used..self.end, 0);
        (self.end, self.used) = (self.end - self.used, 0);
        let size = self.unread.min(BLOCK as u64) as usize;
        let block = &mut self.block[self.end..self.end + size];
        read_exact(self.source, block)?;
        self.digest = self.digest.wrapping_add(sum(self.word, block));
        self.word += (size / WORD) as u64;
        self.unread -= size as u64;
        self.end += size;
        Ok(())
    }

    /// Reads to the end.
    pub(crate) fn drain(&mut self) -> Result<(), ReadError> {
        while self.unread > 0 {
            self.used = self.end;
            self.next_block()?;
        }
        Ok(())
    }

    /// Goes on to the next whole word of the content.
    pub(crate) fn align(&mut self) -> Result<(), ReadError> {
        let at = self.length - self.left();
        let gap = (at.next_multiple_of(WORD as u64) - at) as usize;
        self.need(gap)?;
        self.used += gap;
        Ok(())
    }

    pub(crate) fn fixed<const N: usize>(&mut self) -> Result<[u8; N], ReadError> {
        self.need(N)?;
        let bytes = std::array::from_fn(|i| self.block[self.used + i]);
        self.used += N;
        Ok(bytes)
    }

    /// Reads the setting called `name`: a scalar, a short vector, or the code of a variant.
    pub(crate) fn setting<S: Setting>(
        &mut self,
        name: &'static str,
        setting: &mut S,
    ) -> Result<(), ReadError> {
        self.need(S::BYTES)?;
        let known = setting.read(&self.block[self.used..self.used + S::BYTES]);
        self.used += S::BYTES;
        if known { Ok(()) } else { Err(ReadError::Setting(name)) }
    }

    /// Reads an array of `rows` rows of fixed width and the padding behind it; [`array_bytes`] found room for them.
    pub(crate) fn array<F: Field>(&mut self, field: &mut F, rows: usize) -> Result<(), ReadError> {
        self.rows(field, rows)?;
        self.align()
    }

    pub(crate) fn rows<F: Field>(&mut self, field: &mut F, rows: usize) -> Result<(), ReadError> {
        field.allocate(rows, 1);
        let all = rows * F::ROW_BYTES;
        let mut missing = all;
        while missing > 0 {
            self.need(F::ROW_BYTES)?;
            let whole = (self.end - self.used) / F::ROW_BYTES * F::ROW_BYTES;
            let piece = whole.min(missing);
            field.write((all - missing) / F::ROW_BYTES, &self.block[self.used..self.used + piece]);
            self.used += piece;
            missing -= piece;
        }
        Ok(())
    }
}

/// Bytes of an array with the zeros that fill its last word.
pub(crate) fn array_bytes<F: Field>(_: &F, rows: usize, width: usize) -> Option<u64> {
    let bytes = rows.checked_mul(width)?.checked_mul(F::ROW_BYTES)?;
    u64::try_from(bytes).ok()?.checked_next_multiple_of(WORD as u64)
}

pub(crate) fn read_exact(source: &mut dyn Read, bytes: &mut [u8]) -> Result<(), ReadError> {
    source.read_exact(bytes).map_err(|error| match error.kind() {
        ErrorKind::UnexpectedEof => ReadError::Length,
        kind => ReadError::Unreadable(kind),
    })
}
