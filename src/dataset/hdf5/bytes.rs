//! Bytes of a file at an address, and numbers out of them; nothing outside of the file is read or asked for.

use super::error::Decoded;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The bytes of a file, on the disk or in memory.
pub struct Source {
    store: Store,
    length: u64,
    /// What addresses count from.
    pub base: u64,
}

enum Store {
    Disk(Mutex<File>),
    Memory(Vec<u8>),
}

impl Source {
    /// Bytes on the disk, which are read when asked for.
    ///
    /// # Errors
    /// The file cannot be opened or is none.
    pub fn open(path: &Path) -> Decoded<Self> {
        let file = File::open(path).map_err(|e| e.to_string())?;
        let about = file.metadata().map_err(|e| e.to_string())?;
        if !about.is_file() {
            return Err("not a regular file".into());
        }
        Ok(Source { store: Store::Disk(Mutex::new(file)), length: about.len(), base: 0 })
    }

    /// Bytes in memory.
    pub fn memory(bytes: Vec<u8>) -> Self {
        let length = bytes.len() as u64;
        Source { store: Store::Memory(bytes), length, base: 0 }
    }

    /// Bytes of the file.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// `count` bytes from `address` on.
    ///
    /// # Errors
    /// The file does not have them, or cannot be read.
    pub fn read(&self, address: u64, count: u64) -> Decoded<Vec<u8>> {
        let start = self.base.checked_add(address);
        let Some((start, end)) =
            start.and_then(|s| Some((s, s.checked_add(count)?))).filter(|r| r.1 <= self.length)
        else {
            let length = self.length;
            return Err(format!(
                "{count} bytes at {address} are needed, the file has {length}: it is cut off or damaged"
            ));
        };
        match &self.store {
            Store::Memory(bytes) => Ok(bytes[start as usize..end as usize].to_vec()),
            Store::Disk(file) => {
                let mut out = vec![0; count as usize];
                let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
                file.seek(SeekFrom::Start(start))
                    .and_then(|_| file.read_exact(&mut out))
                    .map_err(|e| format!("reading {count} bytes at {address}: {e}"))?;
                Ok(out)
            }
        }
    }

    /// `count` bytes that begin with `signature`, which are left out.
    ///
    /// # Errors
    /// The file does not have them, or they begin otherwise.
    pub fn signed(&self, signature: &[u8; 4], address: u64, count: u64) -> Decoded<Vec<u8>> {
        let mut bytes = self.read(address, count)?;
        if !bytes.starts_with(signature) {
            let name = String::from_utf8_lossy(signature);
            return Err(format!("no {name:?} at {address}: the file is damaged"));
        }
        Ok(bytes.split_off(4))
    }
}

/// A walk over bytes.
pub struct Cursor<'a>(pub &'a [u8]);

impl<'a> Cursor<'a> {
    /// The next bytes.
    ///
    /// # Errors
    /// There are fewer.
    pub fn take(&mut self, count: usize) -> Decoded<&'a [u8]> {
        let (taken, rest) =
            self.0.split_at_checked(count).ok_or("a structure is cut off: the file is damaged")?;
        self.0 = rest;
        Ok(taken)
    }

    /// The next byte.
    ///
    /// # Errors
    /// There is none.
    pub fn byte(&mut self) -> Decoded<u8> {
        Ok(self.take(1)?[0])
    }

    /// The next number of `width` bytes, at most eight.
    ///
    /// # Errors
    /// There are fewer bytes.
    pub fn number(&mut self, width: usize) -> Decoded<u64> {
        let mut own = [0; 8];
        own[..width].copy_from_slice(self.take(width)?);
        Ok(u64::from_le_bytes(own))
    }

    /// The next two bytes as a number.
    ///
    /// # Errors
    /// There are fewer bytes.
    pub fn short(&mut self) -> Decoded<usize> {
        Ok(self.number(2)? as usize)
    }

    /// The next address or length.
    ///
    /// # Errors
    /// There are fewer bytes.
    pub fn long(&mut self) -> Decoded<u64> {
        self.number(8)
    }
}
