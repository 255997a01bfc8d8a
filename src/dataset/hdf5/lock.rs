//! A file with one writer.

use std::fs::{File, TryLockError};
use std::io::{Error, ErrorKind, Result};
use std::ops::{Deref, DerefMut};

/// A file that no second process of ours writes, and that everybody may read.
///
/// Programs that use the HDF5 library take a shared lock to read and an exclusive one to write; so the writer holds a
/// shared one, after an exclusive one has shown that it is alone.
pub struct Lock(File);

impl Lock {
    /// Takes the lock.
    ///
    /// # Errors
    /// Another process has the file, or the system refuses.
    pub fn take(file: File) -> Result<Self> {
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(Error::new(ErrorKind::ResourceBusy, "another process has this file open"));
            }
            // Without locks in the file system, two processes are not kept apart.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                return Ok(Lock(file));
            }
            Err(TryLockError::Error(error)) => return Err(error),
        }
        // Windows refuses writes under a shared lock, also its holder's.
        if cfg!(not(windows)) {
            file.unlock()?;
            file.lock_shared()?;
        }
        Ok(Lock(file))
    }
}

impl Deref for Lock {
    type Target = File;

    fn deref(&self) -> &File {
        &self.0
    }
}

impl DerefMut for Lock {
    fn deref_mut(&mut self) -> &mut File {
        &mut self.0
    }
}
