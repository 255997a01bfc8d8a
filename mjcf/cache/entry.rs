//! The content of a cache entry: what the compile read, its warnings, then the model.

use std::fs::File;
use std::io::{BufWriter, Read, Write};

use physics::model::binary;

use super::reads::{Reads, Seen};
use crate::diagnostic::{Diagnostic, Position, Severity};
use crate::digest::Digest;
use crate::files::Stamp;
use crate::loaded::Loaded;

/// Writes a model: checksum and length of the list of files and warnings, the list, the model.
pub(super) fn write(file: &mut File, reads: &Reads, loaded: &Loaded) -> std::io::Result<()> {
    let mut list = Vec::new();
    put_count(&mut list, reads.len());
    for (path, seen) in reads {
        put_text(&mut list, path);
        match seen {
            Seen::Content(Some(digest), stamp) => {
                list.push(if stamp.is_some() { 4 } else { 2 });
                list.extend(digest);
                if let Some(stamp) = stamp {
                    list.extend(
                        [stamp.length, stamp.changed as u64, stamp.place]
                            .map(u64::to_le_bytes)
                            .as_flattened(),
                    );
                }
            }
            Seen::Content(None, _) => list.push(3),
            Seen::Exists(exists) => list.push(u8::from(*exists)),
        }
    }
    put_count(&mut list, loaded.warnings.list.len());
    loaded.warnings.list.iter().for_each(|warning| put_warning(&mut list, warning));
    let mut out = BufWriter::with_capacity(1 << 16, file);
    out.write_all(&binary::checksum(&list).to_le_bytes())?;
    out.write_all(&(list.len() as u64).to_le_bytes())?;
    out.write_all(&list)?;
    loaded.model.write(&mut out)?;
    out.flush()
}

/// Reads the list at the start of an entry of `left` bytes; afterwards `left` counts the bytes of the model.
pub(super) fn read_list(source: &mut impl Read, left: &mut u64) -> Option<(Reads, Vec<Diagnostic>)> {
    let mut head = [0; 16];
    source.read_exact(&mut head).ok()?;
    let (checksum, mut length) = head.split_at(8);
    let length = take_count(&mut length)?;
    *left = left.checked_sub(16)?.checked_sub(length as u64)?;
    let mut list = vec![0; length];
    source.read_exact(&mut list).ok()?;
    if binary::checksum(&list).to_le_bytes() != *checksum {
        return None;
    }
    let list = &mut &list[..];
    let mut reads = Reads::new();
    for _ in 0..take_count(list)? {
        let path = take_text(list)?;
        let seen = match take(list, 1)?[0] {
            2 => Seen::Content(Some(take_digest(list)?), None),
            4 => Seen::Content(Some(take_digest(list)?), Some(take_stamp(list)?)),
            3 => Seen::Content(None, None),
            exists => Seen::Exists(exists == 1),
        };
        reads.insert(path, seen);
    }
    let mut warnings = Vec::new();
    for _ in 0..take_count(list)? {
        warnings.push(take_warning(list)?);
    }
    Some((reads, warnings))
}

fn put_count(out: &mut Vec<u8>, n: usize) {
    out.extend((n as u64).to_le_bytes());
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    put_count(out, text.len());
    out.extend(text.as_bytes());
}

fn put_optional(out: &mut Vec<u8>, text: Option<&str>) {
    put_count(out, usize::from(text.is_some()));
    text.iter().for_each(|text| put_text(out, text));
}

fn put_position(out: &mut Vec<u8>, position: &Position) {
    put_text(out, &position.path);
    put_count(out, position.line);
    put_count(out, position.column);
}

fn put_warning(out: &mut Vec<u8>, warning: &Diagnostic) {
    put_text(out, &warning.message);
    put_count(out, usize::from(warning.position.is_some()));
    warning.position.iter().for_each(|position| put_position(out, position));
    put_count(out, warning.include_chain.len());
    warning.include_chain.iter().for_each(|position| put_position(out, position));
    put_optional(out, warning.element.as_deref());
    put_optional(out, warning.hint.as_deref());
}

fn take<'a>(from: &mut &'a [u8], n: usize) -> Option<&'a [u8]> {
    let (taken, rest) = from.split_at_checked(n)?;
    *from = rest;
    Some(taken)
}

fn take_count(from: &mut &[u8]) -> Option<usize> {
    usize::try_from(u64::from_le_bytes(take(from, 8)?.try_into().ok()?)).ok()
}

fn take_digest(from: &mut &[u8]) -> Option<Digest> {
    take(from, 16)?.try_into().ok()
}

fn take_stamp(from: &mut &[u8]) -> Option<Stamp> {
    let mut word = || Some(u64::from_le_bytes(take(from, 8)?.try_into().ok()?));
    Some(Stamp { length: word()?, changed: word()? as i64, place: word()? })
}

fn take_text(from: &mut &[u8]) -> Option<String> {
    let length = take_count(from)?;
    String::from_utf8(take(from, length)?.to_vec()).ok()
}

fn take_optional(from: &mut &[u8]) -> Option<Option<String>> {
    if take_count(from)? == 1 { take_text(from).map(Some) } else { Some(None) }
}

fn take_position(from: &mut &[u8]) -> Option<Position> {
    Some(Position { path: take_text(from)?, line: take_count(from)?, column: take_count(from)? })
}

fn take_warning(from: &mut &[u8]) -> Option<Diagnostic> {
    let message = take_text(from)?;
    let position = if take_count(from)? == 1 { Some(take_position(from)?) } else { None };
    let mut include_chain = Vec::new();
    for _ in 0..take_count(from)? {
        include_chain.push(take_position(from)?);
    }
    let (element, hint) = (take_optional(from)?, take_optional(from)?);
    Some(Diagnostic { severity: Severity::Warning, message, position, element, include_chain, hint })
}
