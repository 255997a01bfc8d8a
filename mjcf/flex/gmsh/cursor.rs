//! Numbers of a section one after the other.

use super::section::Section;
use crate::asset::AssetError;

/// Words of a section of text.
pub(super) struct Words<'a> {
    /// With the line that the last word stands on.
    section: Section<'a>,
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub fn new(section: &Section<'a>) -> Self {
        Words { section: *section, rest: section.bytes }
    }

    /// Bytes not read yet.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    /// The section, with the line that the last word stands on.
    pub fn here(&self) -> Section<'a> {
        self.section
    }

    /// The next number, a count, which nothing follows on its line.
    ///
    /// # Errors
    /// As [`Words::number`]; something follows.
    pub fn count(&mut self) -> Result<u64, AssetError> {
        let count = self.number()?;
        let line = self.rest.split(|&b| b == b'\n').next().unwrap_or_default();
        if line.iter().all(u8::is_ascii_whitespace) {
            return Ok(count);
        }
        Err(self.section.malformed("the number of entries needs a line of its own"))
    }

    /// The next number.
    ///
    /// # Errors
    /// There is none, or the word is no number of this type.
    pub fn number<T: std::str::FromStr>(&mut self) -> Result<T, AssetError> {
        let blank = self.rest.iter().take_while(|b| b.is_ascii_whitespace()).count();
        let (blank, rest) = self.rest.split_at(blank);
        let (word, rest) = rest.split_at(rest.iter().take_while(|b| !b.is_ascii_whitespace()).count());
        self.section.line += blank.iter().filter(|&&b| b == b'\n').count();
        self.rest = rest;
        if word.is_empty() {
            return Err(self.section.truncated());
        }
        let read = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        read.ok_or_else(|| {
            let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
            self.section.malformed(format!("'{shown}' is not a number that belongs here"))
        })
    }
}

/// Little-endian numbers of a binary section.
pub(super) struct Bytes<'a> {
    section: Section<'a>,
    rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub fn new(section: &Section<'a>) -> Self {
        Bytes { section: *section, rest: section.bytes }
    }

    /// Bytes not read yet.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    /// A count in digits on a line of its own, as format 2.2 has it before binary entries.
    ///
    /// # Errors
    /// There are no digits, or too many.
    pub fn line_of_digits(&mut self) -> Result<u64, AssetError> {
        let digits = self.rest.iter().take_while(|b| b.is_ascii_digit()).count();
        let text = std::str::from_utf8(&self.rest[..digits]).unwrap_or_default();
        let number = text.parse().map_err(|_| self.section.malformed("it does not begin with a count"))?;
        self.rest = &self.rest[digits..];
        self.rest = self.rest.strip_prefix(b"\r").unwrap_or(self.rest);
        self.rest = self.rest.strip_prefix(b"\n").unwrap_or(self.rest);
        Ok(number)
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], AssetError> {
        let (first, rest) = self.rest.split_first_chunk().ok_or_else(|| self.section.truncated())?;
        self.rest = rest;
        Ok(*first)
    }

    pub fn int(&mut self) -> Result<i32, AssetError> {
        self.take().map(i32::from_le_bytes)
    }

    pub fn long(&mut self) -> Result<u64, AssetError> {
        self.take().map(u64::from_le_bytes)
    }

    pub fn real(&mut self) -> Result<f64, AssetError> {
        self.take().map(f64::from_le_bytes)
    }
}
