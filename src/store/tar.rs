//! Tar archives: POSIX headers with the extensions of pax and GNU for long names and sizes.
//!
//! The archive is read as a stream, once. Links, devices and sparse files are refused: nothing that a model needs is one,
//! and each is a way to write outside of a folder or to unpack more than is there.

use crate::error::StoreError;
use crate::intake::Intake;
use std::io::{self, Read};

/// Bytes of a header, and what contents are padded to.
pub(crate) const BLOCK: usize = 512;

/// Most bytes of an extended header.
const MAX_EXTENSION: u64 = 1 << 16;

/// What an extended header says of the entry after it.
#[derive(Default)]
struct Extension {
    path: Option<Vec<u8>>,
    size: Option<u64>,
}

/// Takes every file of an archive.
///
/// # Errors
/// The archive is damaged or truncated, or an entry is refused.
pub(crate) fn read<R: Read>(archive: &mut R, intake: &mut Intake<'_>) -> Result<(), StoreError> {
    let mut extension = Extension::default();
    let mut last = String::from("(the first)");
    let mut block = [0; BLOCK];
    loop {
        archive.read_exact(&mut block).map_err(|error| intake.unreadable(&last, error))?;
        if block.iter().all(|&byte| byte == 0) {
            return finish(archive).map_err(|error| intake.unreadable(&last, error));
        }
        if !is_header(&block) {
            return Err(intake.refused(&last, "what follows is no tar header: no tar archive, or damaged"));
        }
        let size = match extension.size.take() {
            Some(size) => Some(size),
            None => number(&block[124..136]),
        };
        let raw = extension.path.take().unwrap_or_else(|| name(&block));
        let shown = String::from_utf8_lossy(&raw).into_owned();
        let size = size.ok_or_else(|| intake.refused(&shown, "its size is no number"))?;
        let mut content = archive.by_ref().take(size);
        match block[156] {
            b'x' => extend(&mut extension, &mut content).map_err(|error| intake.unreadable(&shown, error))?,
            b'L' => {
                let text = bytes(&mut content).map_err(|error| intake.unreadable(&shown, error))?;
                extension.path = Some(until_nul(&text).to_vec());
            }
            // Defaults for all entries, in which git leaves a comment; and the target of a link, which is refused itself.
            b'g' | b'K' => {}
            kind => {
                let path = intake.entry(&raw)?;
                match kind {
                    _ if is_folder(kind, &raw) => {}
                    b'0' | 0 | b'7' => intake.file(path, &mut content)?,
                    kind => return Err(intake.not_plain(&shown, &description(kind))),
                }
            }
        }
        skip(content, size).map_err(|error| intake.unreadable(&shown, error))?;
        last = shown;
    }
}

/// Whether a block is a header: its checksum is right.
pub(crate) fn is_header(block: &[u8; BLOCK]) -> bool {
    let sum = |bytes: &[u8]| bytes.iter().map(|&byte| u64::from(byte)).sum::<u64>();
    let blanks = 8 * u64::from(b' ');
    number(&block[148..156]) == Some(sum(&block[..148]) + blanks + sum(&block[156..]))
}

/// Old archives write a folder as a file whose name ends with a slash.
fn is_folder(kind: u8, raw: &[u8]) -> bool {
    kind == b'5' || (matches!(kind, 0 | b'0') && raw.ends_with(b"/"))
}

/// What an entry of a kind that is not taken is.
fn description(kind: u8) -> String {
    let what = match kind {
        b'1' => "a hard link",
        b'2' => "a symbolic link",
        b'3' | b'4' => "a device",
        b'6' => "a pipe",
        b'S' => "a sparse file",
        b'M' | b'V' => "a part of an archive of several volumes",
        kind => return format!("of the unknown kind {:?}", char::from(kind)),
    };
    what.to_owned()
}

/// Drops what is left of a content of `size` bytes, and its padding.
fn skip<R: Read>(mut content: io::Take<&mut R>, size: u64) -> io::Result<()> {
    let left = content.limit();
    let dropped = io::copy(&mut content, &mut io::sink())?;
    let padding = size.next_multiple_of(BLOCK as u64) - size;
    let padded = io::copy(&mut content.into_inner().take(padding), &mut io::sink())?;
    if (dropped, padded) == (left, padding) { Ok(()) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
}

/// Reads on to the end of the file, so that the checksums of a compressed archive are compared too.
fn finish(archive: &mut impl Read) -> io::Result<()> {
    let mut block = [0; BLOCK];
    loop {
        match archive.read(&mut block)? {
            0 => return Ok(()),
            n if block[..n].iter().any(|&byte| byte != 0) => {
                return Err(io::Error::other("data follows the end of the archive"));
            }
            _ => {}
        }
    }
}

/// A number in octal digits, or in binary where the first bit is set.
fn number(field: &[u8]) -> Option<u64> {
    if field[0] & 0x80 != 0 {
        let first = u64::from(field[0] & 0x7f);
        return field[1..].iter().try_fold(first, |n, &byte| n.checked_mul(256)?.checked_add(byte.into()));
    }
    let digits = std::str::from_utf8(until_nul(field)).ok()?.trim_matches(' ');
    // A header without content may leave the field empty.
    if digits.is_empty() { Some(0) } else { u64::from_str_radix(digits, 8).ok() }
}

/// The name in a header, with the prefix that POSIX headers have.
fn name(block: &[u8; BLOCK]) -> Vec<u8> {
    let name = until_nul(&block[..100]);
    let prefix = until_nul(&block[345..500]);
    match &block[257..263] == b"ustar\0" && !prefix.is_empty() {
        true => [prefix, b"/", name].concat(),
        false => name.to_vec(),
    }
}

fn until_nul(bytes: &[u8]) -> &[u8] {
    bytes.split(|&byte| byte == 0).next().unwrap_or_default()
}

/// The content of an extended header.
fn bytes<R: Read>(content: &mut io::Take<R>) -> io::Result<Vec<u8>> {
    let size = content.limit();
    if size > MAX_EXTENSION {
        return Err(io::Error::other(format!("its extended header has more than {MAX_EXTENSION} bytes")));
    }
    let mut bytes = Vec::new();
    content.read_to_end(&mut bytes)?;
    if bytes.len() as u64 == size { Ok(bytes) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
}

/// Reads pax records: `LENGTH KEY=VALUE\n`, where the length counts the whole record.
fn extend<R: Read>(extension: &mut Extension, content: &mut io::Take<R>) -> io::Result<()> {
    let damaged = || io::Error::other("its extended header is damaged");
    let bytes = bytes(content)?;
    let mut rest = &bytes[..];
    while !rest.is_empty() {
        let blank = rest.iter().position(|&byte| byte == b' ').ok_or_else(damaged)?;
        let length = std::str::from_utf8(&rest[..blank]).ok().and_then(|text| text.parse::<usize>().ok());
        let length = length.filter(|n| (blank + 2..=rest.len()).contains(n)).ok_or_else(damaged)?;
        let record = rest[blank + 1..length].strip_suffix(b"\n").ok_or_else(damaged)?;
        let equals = record.iter().position(|&byte| byte == b'=').ok_or_else(damaged)?;
        let (key, value) = (&record[..equals], &record[equals + 1..]);
        match key {
            b"path" => extension.path = Some(value.to_vec()),
            b"size" => {
                let size = std::str::from_utf8(value).ok().and_then(|text| text.parse().ok());
                extension.size = Some(size.ok_or_else(damaged)?);
            }
            key if key.starts_with(b"GNU.sparse.") => {
                return Err(io::Error::other(
                    "the entry after it is a sparse file, which an import does not take",
                ));
            }
            _ => {}
        }
        rest = &rest[length..];
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_octal_or_binary() {
        assert_eq!(number(b"0000644\0"), Some(0o644));
        assert_eq!(number(b"  12 \0\0\0"), Some(0o12));
        assert_eq!(number(b"\0\0\0\0\0\0\0\0"), Some(0));
        assert_eq!(number(b"0000648\0"), None);
        assert_eq!(number(b"\xff\xfe \0\0\0\0\0\0\0\0\0"), None);
        assert_eq!(number(b"\x80\0\0\0\0\0\0\x02\0\0\0\x01"), Some((2 << 32) + 1));
        assert_eq!(number(b"\x80\0\0\0\0\0\x01\0"), Some(256));
        // Negative, or beyond 64 bits.
        assert_eq!(number(&[0xff; 12]), None);
        assert_eq!(number(b"\x80\0\x01\0\0\0\0\0\0\0\0\0"), None);
    }
}
