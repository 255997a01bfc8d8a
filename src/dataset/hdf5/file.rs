//! An HDF5 file that is read: groups, datasets, attributes.

use super::bytes::{Cursor, Source};
use super::dataset::{Dataset, referred};
use super::datatype::Datatype;
use super::encode::{SIGNATURE, WRITER, kind};
use super::error::{Decoded, Hdf5Error};
use super::group;
use super::header::{self, Message};
use crate::npy::Dtype;
use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

pub use super::group::Member;

/// Groups inside of groups at most.
const MAX_DEPTH: usize = 32;

/// Links followed from one name at most.
const MAX_LINKS: usize = 16;

/// Objects below one group at most.
const MAX_OBJECTS: usize = 1 << 20;

/// Bytes that are searched at once.
const WINDOW: u64 = 1 << 20;

/// A file; only what is asked for is read.
pub struct Hdf5Reader {
    path: PathBuf,
    source: Source,
    root: u64,
    /// The end that the superblock gives, and its version.
    end: u64,
    version: u8,
}

impl Hdf5Reader {
    /// Opens a file on the disk.
    ///
    /// # Errors
    /// It cannot be read, is no HDF5 file, or is shorter than it says.
    pub fn open(path: &Path) -> Result<Self, Hdf5Error> {
        let reader = Self::open_damaged(path)?;
        reader.complete().map_err(|message| reader.fail("", message))?;
        Ok(reader)
    }

    /// Opens a file on the disk whose end may be missing.
    ///
    /// # Errors
    /// It cannot be read or is no HDF5 file.
    pub fn open_damaged(path: &Path) -> Result<Self, Hdf5Error> {
        let fail = |message| Hdf5Error { path: path.to_owned(), object: String::new(), message };
        let reader = Source::open(path).and_then(Self::start).map_err(fail)?;
        Ok(Hdf5Reader { path: path.to_owned(), ..reader })
    }

    /// Opens a file that [`super::append::Appender`] made by the last root group in it that is readable, whatever its
    /// superblock says; nothing if there is none.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn open_earlier(path: &Path) -> Result<Option<Self>, Hdf5Error> {
        let fail = |message| Hdf5Error { path: path.to_owned(), object: String::new(), message };
        let source = Source::open(path).map_err(fail)?;
        let end = source.length();
        let mut reader = Hdf5Reader { path: path.to_owned(), source, root: 0, end, version: 2 };
        let mut stop = end;
        while stop > 0 {
            let start = stop.saturating_sub(WINDOW) / 8 * 8;
            // Headers begin at multiples of eight.
            let bytes = reader.source.read(start, stop - start).map_err(fail)?;
            for (i, word) in bytes.as_chunks::<8>().0.iter().enumerate().rev() {
                if word.starts_with(b"OHDR") {
                    reader.root = start + 8 * i as u64;
                    if reader.appendable_end().is_some() && reader.members("").is_ok() {
                        return Ok(Some(reader));
                    }
                }
            }
            stop = start;
        }
        Ok(None)
    }

    /// Opens bytes in memory.
    ///
    /// # Errors
    /// They are no HDF5 file, or fewer than it says.
    pub fn memory(bytes: Vec<u8>) -> Result<Self, Hdf5Error> {
        let fail = |message| Hdf5Error { path: PathBuf::new(), object: String::new(), message };
        let reader = Self::start(Source::memory(bytes)).map_err(fail)?;
        reader.complete().map_err(fail)?;
        Ok(reader)
    }

    fn start(mut source: Source) -> Decoded<Self> {
        let Superblock { version, base, end, root } = superblock(&source)?;
        source.base = base;
        Ok(Hdf5Reader { path: PathBuf::new(), source, root, end, version })
    }

    fn complete(&self) -> Decoded<()> {
        let length = self.source.length();
        if self.end <= length {
            return Ok(());
        }
        Err(format!(
            "the file has {length} of its {} bytes: it is cut off; `robohive data repair` saves what is readable",
            self.end
        ))
    }

    fn fail(&self, object: &str, message: String) -> Hdf5Error {
        Hdf5Error { path: self.path.clone(), object: object.to_owned(), message }
    }

    /// The file; empty for bytes in memory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where [`super::append::Appender`] goes on, if it made this file.
    pub fn appendable_end(&self) -> Option<u64> {
        let ours = self.attributes().is_ok_and(|list| list.iter().any(|(name, _)| name == WRITER));
        (ours && self.version == 2 && self.source.base == 0).then_some(self.end.next_multiple_of(8))
    }

    /// Bytes behind the end: what was written of an object that was never completed.
    pub fn unused(&self) -> u64 {
        self.source.length().saturating_sub(self.end)
    }

    /// Texts that are attributes of the root group, in the order of the file.
    ///
    /// # Errors
    /// The file is damaged.
    pub fn attributes(&self) -> Result<Vec<(String, String)>, Hdf5Error> {
        let text = |value| if let Value::Text(text) = value { Some(text) } else { None };
        self.values(self.root).map(|all| only(all, text)).map_err(|message| self.fail("/", message))
    }

    /// Integers that are attributes of the group at a path, in the order of the file.
    ///
    /// # Errors
    /// There is no such group, or the file is damaged.
    pub fn integers(&self, path: &str) -> Result<Vec<(String, i64)>, Hdf5Error> {
        let integer = |value| if let Value::Integer(n) = value { Some(n) } else { None };
        let found = self.resolve(self.root, path, MAX_LINKS).and_then(|address| self.values(address));
        found.map(|all| only(all, integer)).map_err(|message| self.fail(path, message))
    }

    /// Attributes of an object that are single texts or integers.
    fn values(&self, address: u64) -> Decoded<Vec<(String, Value)>> {
        let messages = header::messages(&self.source, address)?;
        let attributes = messages.iter().filter(|message| message.kind == kind::ATTRIBUTE);
        attributes.filter_map(|message| attribute(&self.source, &message.data).transpose()).collect()
    }

    /// Members of the group at a path, `""` for the root, in the order of the file.
    ///
    /// # Errors
    /// There is no such group, or the file is damaged.
    pub fn members(&self, path: &str) -> Result<Vec<(String, Member)>, Hdf5Error> {
        let found = self.resolve(self.root, path, MAX_LINKS).and_then(|address| self.group(address));
        found.map_err(|message| self.fail(if path.is_empty() { "/" } else { path }, message))
    }

    fn group(&self, address: u64) -> Decoded<Vec<(String, Member)>> {
        let messages = header::messages(&self.source, address)?;
        group::members(&self.source, &messages)?.ok_or_else(|| "this is no group".into())
    }

    /// Address of the object at a path from the group at `start`; `links` are followed at most.
    fn resolve(&self, start: u64, path: &str, links: usize) -> Decoded<u64> {
        let mut address = if path.starts_with('/') { self.root } else { start };
        for name in path.split('/').filter(|name| !name.is_empty() && *name != ".") {
            let member = self.group(address)?.into_iter().find(|(found, _)| found == name);
            let (_, member) = member.ok_or_else(|| format!("there is no {name:?}"))?;
            address = self.target(address, &member, links)?;
        }
        Ok(address)
    }

    /// Address that a member of the group at `group` leads to.
    fn target(&self, group: u64, member: &Member, links: usize) -> Decoded<u64> {
        match member {
            Member::Object(address) => Ok(*address),
            Member::Soft(path) => {
                let links = links.checked_sub(1).ok_or("a soft link leads in circles")?;
                self.resolve(group, path, links)
                    .map_err(|e| format!("the soft link to {path:?} leads nowhere: {e}"))
            }
            Member::External => Err("links to other files are not followed".into()),
        }
    }

    /// Paths of all objects below the group of `name`, which are no groups, in the order of the file, and where they are.
    ///
    /// # Errors
    /// The file is damaged, or its groups form a circle.
    pub fn walk(&self, name: &str, member: &Member) -> Result<Vec<(String, u64)>, Hdf5Error> {
        let mut out = Vec::new();
        let walked = self.target(self.root, member, MAX_LINKS).map_err(|e| (name.to_owned(), e));
        walked
            .and_then(|address| self.walk_into(address, &mut Vec::new(), "", &mut out))
            .map_err(|(object, message)| self.fail(&[name, &object].join("/"), message))?;
        Ok(out)
    }

    fn walk_into(
        &self,
        address: u64,
        above: &mut Vec<u64>,
        path: &str,
        out: &mut Vec<(String, u64)>,
    ) -> Result<(), (String, String)> {
        let fail = |message: String| (path.to_owned(), message);
        if above.contains(&address) || above.len() == MAX_DEPTH || out.len() > MAX_OBJECTS {
            return Err(fail("groups form a circle, or are nested too deeply: the file is damaged".into()));
        }
        let messages = header::messages(&self.source, address).map_err(fail)?;
        let Some(members) = group::members(&self.source, &messages).map_err(fail)? else {
            out.push((path.to_owned(), address));
            return Ok(());
        };
        above.push(address);
        for (name, member) in members {
            let below = if path.is_empty() { name } else { format!("{path}/{name}") };
            let target = self.target(address, &member, MAX_LINKS).map_err(|e| (below.clone(), e))?;
            self.walk_into(target, above, &below, out)?;
        }
        above.pop();
        Ok(())
    }

    /// The dataset whose header is at `address`; `name` is for errors.
    ///
    /// # Errors
    /// There is none, or the file is damaged.
    pub fn dataset(&self, name: &str, address: u64) -> Result<Dataset, Hdf5Error> {
        let decoded = || {
            let messages: Vec<Message> = header::messages(&self.source, address)?;
            Dataset::decode(&self.source, &messages)?
                .ok_or_else(|| "this is neither group nor dataset".into())
        };
        decoded().map_err(|message| self.fail(name, message))
    }

    /// The bytes of rows of a dataset; `name` is for errors.
    ///
    /// # Errors
    /// There are no such rows, or the file is damaged.
    pub fn rows(&self, name: &str, dataset: &Dataset, rows: Range<usize>) -> Result<Vec<u8>, Hdf5Error> {
        dataset.read(&self.source, rows).map_err(|message| self.fail(name, message))
    }

    /// The texts of a dataset; `name` is for errors.
    ///
    /// # Errors
    /// They are none, or the file is damaged.
    pub fn texts(&self, name: &str, dataset: &Dataset) -> Result<Vec<String>, Hdf5Error> {
        dataset.texts(&self.source).map_err(|message| self.fail(name, message))
    }
}

/// What the start of a file says.
struct Superblock {
    version: u8,
    base: u64,
    end: u64,
    root: u64,
}

/// Finds and reads the superblock, which stands at 0 or, behind bytes of the user's, at 512, 1024, 2048 …
fn superblock(source: &Source) -> Decoded<Superblock> {
    let mut start = 0;
    while source.read(start, 8)? != SIGNATURE {
        start = if start == 0 { 512 } else { 2 * start };
        if start + 8 > source.length() {
            return Err("this is no HDF5 file: the signature is missing".into());
        }
    }
    let most = (source.length() - start).min(96);
    let bytes = source.read(start, most)?;
    let mut at = Cursor(&bytes[8..]);
    let version = at.byte()?;
    let widths = |widths: &[u8]| match widths {
        [8, 8] => Ok(()),
        _ => Err("addresses of other than eight bytes are not read".to_owned()),
    };
    let found = match version {
        0 | 1 => {
            at.take(4)?;
            widths(at.take(2)?)?;
            at.take(if version == 0 { 9 } else { 13 })?;
            let (base, _free, end, _driver, _name) =
                (at.long()?, at.long()?, at.long()?, at.long()?, at.long()?);
            Superblock { version, base, end, root: at.long()? }
        }
        2 | 3 => {
            widths(at.take(2)?)?;
            at.byte()?;
            let (base, _extension, end) = (at.long()?, at.long()?, at.long()?);
            let root = at.long()?;
            let sum = at.number(4)?;
            if u64::from(super::checksum::lookup3(&bytes[..44])) != sum {
                return Err("the checksum of the superblock is wrong: the file is damaged".into());
            }
            Superblock { version, base, end, root }
        }
        other => return Err(format!("superblock version {other} is unknown (0 to 3 are read)")),
    };
    // A block of the user's may have been put before the file later.
    Ok(Superblock { base: found.base.max(start), ..found })
}

/// Value of an attribute.
enum Value {
    Text(String),
    Integer(i64),
}

/// Attributes of one kind.
fn only<T>(all: Vec<(String, Value)>, kind: impl Fn(Value) -> Option<T>) -> Vec<(String, T)> {
    all.into_iter().filter_map(|(name, value)| Some((name, kind(value)?))).collect()
}

/// Name and value of an attribute; nothing for an array, or elements of another type.
fn attribute(source: &Source, body: &[u8]) -> Decoded<Option<(String, Value)>> {
    let mut at = Cursor(body);
    let version = at.byte()?;
    at.byte()?;
    let lengths = [at.short()?, at.short()?, at.short()?];
    at.take(if version == 3 { 1 } else { 0 })?;
    let padded = lengths.map(|length| if version == 1 { length.next_multiple_of(8) } else { length });
    let (name, datatype, space) = (at.take(padded[0])?, at.take(padded[1])?, at.take(padded[2])?);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end_matches('\0').to_owned();
    if space.get(1) != Some(&0) {
        return Ok(None);
    }
    let value = match super::datatype::decode(datatype)? {
        Datatype::FixedText(bytes) => Value::Text(text(at.take(bytes as usize)?)),
        Datatype::Text => Value::Text(text(&referred(source, &mut HashMap::new(), at.take(16)?)?)),
        Datatype::Number { dtype: Dtype::I64, big_endian: false } => {
            let bytes = at.take(8)?.first_chunk::<8>().ok_or("an attribute is cut off")?;
            Value::Integer(i64::from_le_bytes(*bytes))
        }
        _ => return Ok(None),
    };
    Ok(Some((text(name), value)))
}
