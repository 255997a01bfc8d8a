//! The bytes of a pickle, read from front to back.

use super::error::PickleError;
use std::ops::Range;

/// Bytes and how many of them are read.
pub(super) struct Input<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> Input<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Input { bytes, position: 0 }
    }

    pub fn position(&self) -> usize {
        self.position
    }

    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// The next `length` bytes, by their place.
    pub fn span(&mut self, length: usize) -> Result<Range<usize>, PickleError> {
        let left = self.bytes.len() - self.position;
        if length > left {
            let message = format!("{length} bytes should follow, and only {left} do: the file is cut off");
            return Err(PickleError::at(self.position, message));
        }
        let start = self.position;
        self.position += length;
        Ok(start..self.position)
    }

    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], PickleError> {
        let span = self.span(N)?;
        let mut array = [0; N];
        array.copy_from_slice(&self.bytes[span]);
        Ok(array)
    }

    pub fn byte(&mut self) -> Result<u8, PickleError> {
        Ok(self.array::<1>()?[0])
    }

    /// A length of `N` bytes, little-endian, and as many bytes as it says.
    pub fn counted<const N: usize>(&mut self) -> Result<Range<usize>, PickleError> {
        let start = self.position;
        let length =
            self.array::<N>()?.iter().rev().fold(0u64, |length, &byte| length << 8 | u64::from(byte));
        let length = usize::try_from(length)
            .map_err(|_| PickleError::at(start, format!("{length} bytes are more than any file has")))?;
        self.span(length)
    }

    /// A line without its end.
    pub fn line(&mut self) -> Result<Range<usize>, PickleError> {
        let length = self.rest().iter().position(|&byte| byte == b'\n').ok_or_else(|| {
            PickleError::at(self.position, "a line should follow, and none ends: the file is cut off")
        })?;
        let line = self.span(length)?;
        self.position += 1;
        Ok(line)
    }

    /// Bytes that must be text.
    pub fn text(&self, span: Range<usize>) -> Result<Range<usize>, PickleError> {
        match std::str::from_utf8(&self.bytes[span.clone()]) {
            Ok(_) => Ok(span),
            Err(error) => {
                Err(PickleError::at(span.start + error.valid_up_to(), "the text is not valid UTF-8"))
            }
        }
    }

    /// A little-endian integer in two's complement; `None` where i64 does not hold it.
    pub fn integer(&self, span: &Range<usize>) -> Option<i64> {
        let bytes = &self.bytes[span.clone()];
        let negative = bytes.last().is_some_and(|byte| byte & 0x80 != 0);
        let mut wide = [if negative { 0xff } else { 0 }; 8];
        wide.get_mut(..bytes.len())?.copy_from_slice(bytes);
        Some(i64::from_le_bytes(wide))
    }
}
