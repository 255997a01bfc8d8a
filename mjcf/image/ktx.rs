//! KTX containers, version 1.1 and 2.0: what their headers say must be there. Pixels are not decoded.

use crate::asset::AssetError;

/// What a file of version 1.1 begins with.
const FIRST: [u8; 12] = *b"\xabKTX 11\xbb\r\n\x1a\n";
/// The same of version 2.0.
const SECOND: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// The header of version 1.1, mark included.
const FIRST_HEADER: usize = 64;
/// Where the list of levels of version 2.0 begins, and the bytes of one.
const LEVELS: usize = 80;
const LEVEL: usize = 24;

/// Longest side of a texture, and most of any other count.
const MOST: u64 = 1 << 16;

/// Checks that the parts which the headers name lie in the file.
///
/// # Errors
/// The file is none of the two versions, has impossible sizes, or ends before its parts do.
pub(super) fn check(bytes: &[u8], path: &str) -> Result<(), AssetError> {
    let file = File { bytes, path };
    match bytes.first_chunk() {
        Some(&FIRST) => file.first_version(),
        Some(&SECOND) => file.second_version(),
        _ => Err(file.malformed("does not begin as KTX files of version 1.1 and 2.0 do")),
    }
}

struct File<'a> {
    bytes: &'a [u8],
    path: &'a str,
}

impl File<'_> {
    fn malformed(&self, why: &str) -> AssetError {
        AssetError::malformed(format!("KTX file '{}' {why}: export it again", self.path))
    }

    fn number<const N: usize>(&self, at: usize) -> Result<[u8; N], AssetError> {
        let number = self.bytes.get(at..).and_then(<[u8]>::first_chunk);
        number.copied().ok_or_else(|| self.cut_short(at as u64 + N as u64))
    }

    fn cut_short(&self, needed: u64) -> AssetError {
        let has = self.bytes.len();
        AssetError::truncated(format!(
            "KTX file '{}' has {has} bytes, and by its header at least {needed}: it is cut short, copy or export it again",
            self.path
        ))
    }

    /// Refuses a file that ends before `end`.
    fn reaches(&self, end: u64) -> Result<(), AssetError> {
        if self.bytes.len() as u64 >= end { Ok(()) } else { Err(self.cut_short(end)) }
    }

    fn sides(&self, [width, height, depth]: [u64; 3]) -> Result<(), AssetError> {
        if (1..=MOST).contains(&width) && (1..=MOST).contains(&height) && depth <= 1 {
            return Ok(());
        }
        Err(self.malformed(&format!("is {width} x {height} x {depth} pixels, which is no flat picture")))
    }

    /// Marks, then thirteen numbers, pairs of texts, and each level with its length before it.
    fn first_version(&self) -> Result<(), AssetError> {
        let little = match self.number(12)? {
            [1, 2, 3, 4] => true,
            [4, 3, 2, 1] => false,
            _ => return Err(self.malformed("does not say the order of its bytes")),
        };
        let number = |at: usize| {
            let bytes = self.number(at)?;
            Ok(u64::from(if little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) }))
        };
        let field = |k: usize| number(12 + 4 * k);
        self.sides([field(6)?, field(7)?, field(8)?])?;
        let (faces, levels, texts) = (field(10)?, field(11)?.max(1), field(12)?);
        self.counts(faces, levels)?;
        let mut at = FIRST_HEADER as u64 + texts;
        for _ in 0..levels {
            self.reaches(at + 4)?;
            let bytes = number(at as usize)?;
            if bytes == 0 {
                return Err(self.malformed("has a level without pixels"));
            }
            // The length is of one face where there are six, each padded to four bytes.
            let faces = if field(9)? == 0 { faces } else { 1 };
            at += 4 + faces * bytes.next_multiple_of(4);
            self.reaches(at - (bytes.next_multiple_of(4) - bytes))?;
        }
        Ok(())
    }

    /// Nine numbers, places of three tables, then place and length of each level.
    fn second_version(&self) -> Result<(), AssetError> {
        let number = |at: usize| self.number(at).map(|bytes| u64::from(u32::from_le_bytes(bytes)));
        let long = |at: usize| self.number(at).map(u64::from_le_bytes);
        self.sides([number(20)?, number(24)?, number(28)?])?;
        let (faces, levels) = (number(36)?, number(40)?.max(1));
        self.counts(faces, levels)?;
        let tables = [(number(48)?, number(52)?), (number(56)?, number(60)?), (long(64)?, long(72)?)];
        for (start, length) in tables {
            self.reaches(start.saturating_add(length))?;
        }
        for level in 0..levels as usize {
            let at = LEVELS + level * LEVEL;
            let (start, length) = (long(at)?, long(at + 8)?);
            if length == 0 {
                return Err(self.malformed("has a level without pixels"));
            }
            self.reaches(start.saturating_add(length))?;
        }
        Ok(())
    }

    fn counts(&self, faces: u64, levels: u64) -> Result<(), AssetError> {
        if ![1, 6].contains(&faces) {
            return Err(self.malformed(&format!("has {faces} faces, not 1 or 6")));
        }
        if levels > u64::from(MOST.ilog2()) + 1 {
            return Err(self.malformed(&format!("has {levels} levels, more than halvings of its size")));
        }
        Ok(())
    }
}
