//! What goes wrong with a store, in words that say what to do about it.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// Most names that one message lists.
const LISTED: usize = 10;

/// What a missing file may come from.
const IMPORT: &str = "`robohive assets import PATH` brings it, where PATH is a RoboHive checkout or its wheel, \
a simhive folder, or an archive of them";

/// Why a store could not do what it was asked for.
#[derive(Debug)]
#[non_exhaustive]
pub enum StoreError {
    /// The file system refuses.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// Neither `ROBOHIVE_STORE` nor a home folder is set.
    NoFolder,
    /// A text that is no virtual path.
    NotVirtual {
        /// The text.
        path: String,
        /// What is wrong with it.
        reason: String,
    },
    /// No file has this virtual path.
    Missing {
        /// The virtual path.
        path: String,
        /// Store and folders that were searched.
        searched: Vec<PathBuf>,
    },
    /// The manifest lists a file that `tree/` does not have.
    Gone {
        /// The file in the tree.
        path: PathBuf,
    },
    /// The manifest is not one of this version, or damaged.
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
    /// Another process imports into the store.
    Busy {
        /// The lock file.
        lock: PathBuf,
    },
    /// The source is neither a folder nor an archive that can be read.
    Source {
        /// Folder or archive.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// An entry of an archive or folder is refused.
    Entry {
        /// Folder or archive.
        source: PathBuf,
        /// The entry.
        entry: String,
        /// Why.
        reason: String,
    },
    /// A source asks for more than the limits allow.
    Limit {
        /// Folder or archive.
        source: PathBuf,
        /// The entry at which the limit is passed.
        entry: String,
        /// Name of the limit.
        limit: &'static str,
        /// Its value.
        value: u64,
    },
    /// The source has no folder that is known.
    Layout {
        /// Folder or archive.
        source: PathBuf,
        /// Model files in it, all of them elsewhere.
        files: usize,
    },
    /// Files that contradict those stored, or each other.
    Conflict {
        /// Folder or archive.
        source: PathBuf,
        /// Each with both sides.
        files: Vec<String>,
        /// Whether `--replace` settles it.
        replaceable: bool,
    },
}

impl StoreError {
    /// Names the path that an operation failed on.
    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> StoreError {
        let path = path.into();
        move |error| StoreError::Io { path, error }
    }
}

impl fmt::Display for StoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StoreError::Io { path, error } => write!(f, "{}: {error}", path.display()),
            StoreError::NoFolder => f.write_str(
                "no folder for the store: set ROBOHIVE_STORE, or the home folder (HOME, on Windows LOCALAPPDATA)",
            ),
            StoreError::NotVirtual { path, reason } => write!(
                f,
                "{path:?} is no path of a store: {reason}; such a path begins with envs/ or simhive/"
            ),
            StoreError::Missing { path, searched } => {
                write!(f, "{path} is in none of: ")?;
                for (i, folder) in searched.iter().enumerate() {
                    write!(f, "{}{}", if i == 0 { "" } else { ", " }, folder.display())?;
                }
                write!(f, "; {IMPORT}")
            }
            StoreError::Gone { path } => write!(
                f,
                "{}: the store lists this file, but it is gone; `robohive assets verify` names all damage and the \
                 import that repairs it",
                path.display()
            ),
            StoreError::Manifest { path, line, reason } => write!(
                f,
                "{}, line {line}: {reason}; delete this file and import again",
                path.display()
            ),
            StoreError::Busy { lock } => write!(
                f,
                "another import into this store is running ({} is locked); wait until it is done",
                lock.display()
            ),
            StoreError::Source { path, reason } => write!(f, "{}: {reason}", path.display()),
            StoreError::Entry { source, entry, reason } => {
                write!(f, "{}, entry {entry:?}: {reason}", source.display())
            }
            StoreError::Limit { source, entry, limit, value } => write!(
                f,
                "{}, entry {entry:?}: more than the limit {limit}={value} allows; if you trust this source, raise it \
                 with --limit {limit}=NUMBER",
                source.display()
            ),
            StoreError::Layout { source, files } => write!(
                f,
                "{}: none of its {files} model files lies in a simhive folder, in one of the folders that simhive has \
                 (Adroit, franka_sim, myo_sim, ...), or in RoboHive's envs folder; import a RoboHive checkout or its \
                 wheel, a simhive folder, or an archive of them",
                source.display()
            ),
            StoreError::Conflict { source, files, replaceable } => {
                let remedy = match replaceable {
                    true => "nothing is imported; --replace takes the files of this source",
                    false => "nothing is imported; import a folder that has only one of them",
                };
                write!(f, "{}: {} contradictory files; {remedy}:", source.display(), files.len())?;
                files.iter().take(LISTED).try_for_each(|file| write!(f, "\n  {file}"))?;
                match files.len().saturating_sub(LISTED) {
                    0 => Ok(()),
                    more => write!(f, "\n  and {more} more"),
                }
            }
        }
    }
}

impl std::error::Error for StoreError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            StoreError::Io { error, .. } => Some(error),
            _ => None,
        }
    }
}
