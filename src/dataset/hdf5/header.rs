//! Object headers: messages about a group or dataset, in one or several blocks.

use super::bytes::{Cursor, Source};
use super::checksum::lookup3;
use super::encode::kind;
use super::error::Decoded;

/// Blocks of a header at most: far more than a root group of a million members has.
const MAX_BLOCKS: usize = 1 << 16;

/// Bytes of a header at most.
const MAX_BYTES: u64 = 1 << 28;

/// What a header says of one thing.
pub struct Message {
    /// As in [`kind`].
    pub kind: u8,
    /// What is said.
    pub data: Vec<u8>,
}

/// A walk through the blocks of a header.
struct Walk<'a> {
    source: &'a Source,
    /// Blocks to come: address and bytes.
    blocks: Vec<(u64, u64)>,
    seen: usize,
    bytes: u64,
    messages: Vec<Message>,
}

/// The messages of the header at `address`.
///
/// # Errors
/// There is no header, or it is damaged.
pub fn messages(source: &Source, address: u64) -> Decoded<Vec<Message>> {
    let mut walk = Walk { source, blocks: Vec::new(), seen: 0, bytes: 0, messages: Vec::new() };
    if source.read(address, 4)? == b"OHDR" {
        walk.second_version(address)?;
    } else {
        walk.first_version(address)?;
    }
    Ok(walk.messages)
}

impl Walk<'_> {
    fn next_block(&mut self) -> Decoded<Option<(u64, u64)>> {
        // Blocks are read in the order in which the header names them.
        if self.blocks.is_empty() {
            return Ok(None);
        }
        let block = self.blocks.remove(0);
        self.seen += 1;
        self.bytes = self.bytes.saturating_add(block.1);
        if self.seen > MAX_BLOCKS || self.bytes > MAX_BYTES.min(self.source.length()) {
            return Err("an object header leads in circles: the file is damaged".into());
        }
        Ok(Some(block))
    }

    fn note(&mut self, kind: u8, flags: u8, data: &[u8]) -> Decoded<()> {
        if kind == kind::CONTINUATION {
            let mut at = Cursor(data);
            self.blocks.push((at.long()?, at.long()?));
            return Ok(());
        }
        if flags & 2 != 0 && matches!(kind, kind::DATATYPE | kind::DATASPACE | kind::FILTERS) {
            return Err("shared header messages (committed datatypes) are not read".into());
        }
        self.messages.push(Message { kind, data: data.to_vec() });
        Ok(())
    }

    fn first_version(&mut self, address: u64) -> Decoded<()> {
        let start = self.source.read(address, 12)?;
        let mut at = Cursor(&start);
        if at.byte()? != 1 {
            return Err(format!("no object header at {address}: the file is damaged"));
        }
        at.take(7)?;
        self.blocks.push((address.saturating_add(16), at.number(4)?));
        while let Some((address, bytes)) = self.next_block()? {
            let block = self.source.read(address, bytes)?;
            let mut at = Cursor(&block);
            while at.0.len() >= 8 {
                let (kind, size, flags) = (at.short()?, at.short()?, at.byte()?);
                at.take(3)?;
                self.note(u8::try_from(kind).unwrap_or(u8::MAX), flags, at.take(size)?)?;
            }
        }
        Ok(())
    }

    fn second_version(&mut self, address: u64) -> Decoded<()> {
        // Signature, version, flags, four times, two limits of attributes, length.
        let most = self.source.length().saturating_sub(self.source.base).saturating_sub(address).min(34);
        let start = self.source.read(address, most)?;
        let mut at = Cursor(&start);
        at.take(4)?;
        let (version, flags) = (at.byte()?, at.byte()?);
        if version != 2 {
            return Err(format!("object header version {version} is unknown (1 and 2 are read)"));
        }
        at.take(if flags & 0x20 == 0 { 0 } else { 16 } + if flags & 0x10 == 0 { 0 } else { 4 })?;
        let bytes = at.number(1 << (flags & 3))?;
        let prefix = (start.len() - at.0.len()) as u64;
        self.blocks.push((address, bytes.saturating_add(prefix + 4)));
        let (mut skip, ordered) = (prefix as usize, flags & 4 != 0);
        while let Some((address, bytes)) = self.next_block()? {
            let block = self.source.read(address, bytes)?;
            let (body, sum) = block.split_last_chunk::<4>().ok_or("an object header is cut off")?;
            if lookup3(body) != u32::from_le_bytes(*sum) {
                return Err(format!(
                    "the checksum of the object header at {address} is wrong: the file is damaged"
                ));
            }
            let mut at = Cursor(body);
            at.take(skip)?;
            skip = 4;
            let least = if ordered { 6 } else { 4 };
            while at.0.len() >= least {
                let (kind, size, flags) = (at.byte()?, at.short()?, at.byte()?);
                at.take(least - 4)?;
                self.note(kind, flags, at.take(size)?)?;
            }
        }
        Ok(())
    }
}
