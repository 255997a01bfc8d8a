//! One program commands a device.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A lock that other programs on this machine see; it ends with the process that took it, however that ends.
#[derive(Debug)]
pub struct Lock(File);

impl Lock {
    /// Locks what `resource` names.
    ///
    /// # Errors
    /// Another process has it: which one. The lock's file cannot be made.
    pub fn take(resource: &str) -> io::Result<Lock> {
        // A device has several names: links in /dev/serial/by-id, and the node that they lead to. What is no path, such as a
        // host, has one.
        let node = std::fs::canonicalize(resource).ok();
        let node = node.as_deref().and_then(Path::to_str).unwrap_or(resource);
        let name: String = node.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let path: PathBuf = std::env::temp_dir().join(format!("robohive-{name}.lock"));
        let mut file = open(&path).map_err(|error| {
            io::Error::new(
                error.kind(),
                format!("{}: {error}; remove it, if no program is using {resource}", path.display()),
            )
        })?;
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

/// The file, which every user may write: the next who needs the device may be another.
fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true);
    // Asked to make the file, Linux refuses another user's in a folder that all share.
    match options.open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        opened => return opened,
    }
    let file = options.create(true).truncate(false).open(path)?;
    #[cfg(unix)]
    file.set_permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666))?;
    Ok(file)
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Closing the file would do; an error here has nobody to hear it.
        self.0.unlock().unwrap_or_default();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    #[test]
    fn a_device_is_locked_under_all_its_names_and_for_all_users() {
        let folder = std::env::temp_dir().join(format!("robohive-lock-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (node, link) = (folder.join("ttyUSB0"), folder.join("by-id"));
        std::fs::write(&node, "").unwrap();
        symlink(&node, &link).unwrap();
        let [node, link] = [&node, &link].map(|path| path.to_str().unwrap());
        let first = Lock::take(node).unwrap();
        let refused = Lock::take(link).unwrap_err().to_string();
        assert!(refused.contains(&format!("(process {}) is using {link}", std::process::id())), "{refused}");
        let mode = first.0.metadata().unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o666);
        drop(first);
        Lock::take(link).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_that_cannot_be_opened_is_named() {
        let path = std::env::temp_dir().join("robohive-a_folder_in_its_place.lock");
        std::fs::create_dir_all(&path).unwrap();
        let said = Lock::take("a_folder_in_its_place").unwrap_err().to_string();
        std::fs::remove_dir(&path).unwrap();
        assert!(said.starts_with(path.to_str().unwrap()) && said.contains("remove it"), "{said}");
    }
}
