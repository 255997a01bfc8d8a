//! An HDF5 file that grows by whole objects and can be read at every moment.
//!
//! Bytes are only ever added behind those in use, and nothing refers to them until [`Appender::publish`]: it writes a root
//! group that also has the new object behind everything else, and then replaces the superblock, 48 bytes at the start of
//! the file. A process that is killed leaves either superblock; what stands behind the end that it gives is not read by
//! anybody and overwritten by the next object. Before the superblock is replaced the disk is asked to keep the rest, so that the same
//! holds when the power fails.
//!
//! The links of the root group stand in blocks. A full block is never written again, so that the cost of a
//! publication hardly grows with the number of objects.

use super::encode::{self, SUPERBLOCK};
use super::file::{Hdf5Reader, Member};
use super::lock::Lock;
use std::ffi::OsString;
use std::fs::File;
use std::io::{Error, ErrorKind, Result, Seek, SeekFrom, Write};
use std::path::Path;

/// Links in a block of the root group.
const BLOCK: usize = 64;

/// A file that is being written.
pub struct Appender {
    file: Lock,
    /// Where the next bytes go.
    end: u64,
    root: Root,
}

/// What the root group refers to.
#[derive(Clone, Default)]
struct Root {
    /// Messages of attributes.
    attributes: Vec<u8>,
    /// Address and bytes of full blocks of links.
    blocks: Vec<(u64, u64)>,
    /// Links that fill no block.
    rest: Vec<(String, u64)>,
}

impl Appender {
    /// Makes a file with an empty root group and these attributes. It appears at `path` in one piece, replacing what was
    /// there.
    ///
    /// # Errors
    /// The file cannot be written, or another process is writing it.
    pub fn create(path: &Path, attributes: &[(String, String)]) -> Result<Self> {
        match File::open(path) {
            // A file cannot take the place of a folder or a device.
            Ok(file) if !file.metadata()?.is_file() => {
                return Err(Error::new(ErrorKind::InvalidInput, "a recording must be a regular file"));
            }
            Ok(file) => drop(Lock::take(file)?),
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
        let mut new = OsString::from(path);
        new.push(".new");
        let file = File::options().read(true).write(true).create(true).truncate(false).open(&new)?;
        let file = Lock::take(file)?;
        file.set_len(0)?;
        let mut out = Appender { file, end: SUPERBLOCK as u64, root: Root::default() };
        out.describe(attributes)?;
        out.write_root()?;
        std::fs::rename(&new, path)?;
        Ok(out)
    }

    /// Goes on with a file that [`Appender::create`] made: members of its root group stay.
    ///
    /// # Errors
    /// The file cannot be read or written, another process is writing it, or it has another form.
    pub fn open(path: &Path) -> Result<Self> {
        let file = Lock::take(File::options().read(true).write(true).open(path)?)?;
        let reader = Hdf5Reader::open(path).map_err(invalid)?;
        let end = reader.appendable_end().ok_or_else(|| {
            invalid("only a file that this program recorded can be continued: `robohive data convert` makes one of this")
        })?;
        let mut out = Appender { file, end, root: Root::default() };
        out.describe(&reader.attributes().map_err(invalid)?)?;
        for (name, member) in reader.members("").map_err(invalid)? {
            if let Member::Object(address) = member {
                out.add(&name, address)?;
            }
        }
        out.write_root()?;
        Ok(out)
    }

    /// Where the next bytes will stand.
    pub fn end(&self) -> u64 {
        self.end
    }

    /// Adds bytes, to which nothing refers yet, and returns where they stand.
    ///
    /// # Errors
    /// Writing fails; the file is as before.
    pub fn write(&mut self, bytes: &[u8]) -> Result<u64> {
        let address = self.end;
        self.file.seek(SeekFrom::Start(address))?;
        self.file.write_all(bytes)?;
        // Objects begin at multiples of eight. The end counts into the file only with what stands behind it.
        self.end = (address + bytes.len() as u64).next_multiple_of(8);
        Ok(address)
    }

    /// Gives back all bytes from `end` on, to which nothing refers.
    pub fn forget(&mut self, end: u64) {
        self.end = end;
    }

    /// Makes the object whose header is at `address` a member of the root group. When this returns, no end of the process
    /// loses it.
    ///
    /// # Errors
    /// Writing fails; the file has the members that it had before.
    pub fn publish(&mut self, name: &str, address: u64) -> Result<()> {
        let (root, end) = (self.root.clone(), self.end);
        self.add(name, address).and_then(|()| self.write_root()).inspect_err(|_| {
            (self.root, self.end) = (root, end);
        })
    }

    /// Asks the disk to keep everything.
    ///
    /// # Errors
    /// The disk fails.
    pub fn sync(&self) -> Result<()> {
        self.file.sync_all()
    }

    fn describe(&mut self, attributes: &[(String, String)]) -> Result<()> {
        if attributes.is_empty() {
            return Ok(());
        }
        let texts: Vec<String> = attributes.iter().map(|(_, text)| text.clone()).collect();
        let heap = self.write(&encode::global_heap(&texts))?;
        for (i, (name, text)) in attributes.iter().enumerate() {
            self.root.attributes.extend(encode::text_attribute(name, text, heap, i as u32 + 1));
        }
        Ok(())
    }

    /// Notes a member, and writes a block of links when that fills it.
    fn add(&mut self, name: &str, address: u64) -> Result<()> {
        self.root.rest.push((name.to_owned(), address));
        if self.root.rest.len() == BLOCK {
            let links = self.root.rest.iter().flat_map(|(name, address)| encode::link(name, *address));
            let block = encode::header_block(&links.collect::<Vec<_>>());
            let address = self.write(&block)?;
            self.root.blocks.push((address, block.len() as u64));
            self.root.rest.clear();
        }
        Ok(())
    }

    /// Writes the root group behind everything, and the superblock that leads to it.
    fn write_root(&mut self) -> Result<()> {
        let mut messages = encode::group_info();
        messages.extend(&self.root.attributes);
        for &(address, bytes) in &self.root.blocks {
            messages.extend(encode::continuation(address, bytes));
        }
        for (name, address) in &self.root.rest {
            messages.extend(encode::link(name, *address));
        }
        let mut header = encode::object_header(&messages);
        // The file must reach its end as the superblock gives it.
        header.resize(header.len().next_multiple_of(8), 0);
        let root = self.write(&header)?;
        self.file.sync_data()?;
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&encode::superblock(root, self.end))
    }
}

fn invalid(message: impl ToString) -> Error {
    Error::new(ErrorKind::InvalidData, message.to_string())
}
