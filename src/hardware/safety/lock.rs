//! One program commands a device.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;

/// A lock that other programs on this machine see; it ends with the process that took it, however that ends.
#[derive(Debug)]
pub struct Lock(File);

impl Lock {
    /// Locks what `resource` names.
    ///
    /// # Errors
    /// Another process has it: which one. The lock's file cannot be made.
    pub fn take(resource: &str) -> io::Result<Lock> {
        let name: String =
            resource.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let path: PathBuf = std::env::temp_dir().join(format!("robohive-{name}.lock"));
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut owner = String::new();
                file.read_to_string(&mut owner)?;
                let owner = owner.trim();
                let who = if owner.is_empty() { String::new() } else { format!(" (process {owner})") };
                return Err(io::Error::new(
                    io::ErrorKind::ResourceBusy,
                    format!("another program{who} is using {resource}; end it first"),
                ));
            }
            Err(TryLockError::Error(error)) => return Err(error),
        }
        file.set_len(0)?;
        file.seek(SeekFrom::Start(0))?;
        writeln!(file, "{}", std::process::id())?;
        Ok(Lock(file))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Closing the file would do; an error here has nobody to hear it.
        self.0.unlock().unwrap_or_default();
    }
}
