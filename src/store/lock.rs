//! One import at a time.

use crate::error::StoreError;
use std::fs::{File, OpenOptions, TryLockError};
use std::path::Path;

/// Name of the lock file in a store.
const NAME: &str = "lock";

/// Holds the lock of a store until it is dropped. The system releases it when the process ends, however it ends.
pub(crate) struct Lock(#[expect(dead_code, reason = "held open, never read")] File);

impl Lock {
    /// Takes the lock.
    ///
    /// # Errors
    /// The folder cannot be written, or [`StoreError::Busy`] when another process holds the lock.
    pub(crate) fn take(store: &Path) -> Result<Self, StoreError> {
        let path = store.join(NAME);
        let file = open(&path)?;
        match file.try_lock() {
            Ok(()) => Ok(Lock(file)),
            Err(TryLockError::WouldBlock) => Err(StoreError::Busy { lock: path }),
            Err(TryLockError::Error(error)) => Err(StoreError::io(path)(error)),
        }
    }

    /// Waits for the lock.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn wait(store: &Path) -> Result<Self, StoreError> {
        let path = store.join(NAME);
        let file = open(&path)?;
        file.lock().map_err(StoreError::io(path))?;
        Ok(Lock(file))
    }
}

fn open(path: &Path) -> Result<File, StoreError> {
    let file = OpenOptions::new().create(true).truncate(false).write(true).open(path);
    file.map_err(StoreError::io(path))
}
