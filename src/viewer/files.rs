//! Files in memory: what a person dropped on a window or a page, or what a script fetched.

use mjcf::diagnostic::Diagnostics;
use mjcf::files::{FileError, FileProvider, Memory};
use mjcf::{Loaded, Loader};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::io::{Cursor, Read};
use std::sync::{Arc, Mutex, PoisonError};
use zip::ZipArchive;

/// Most bytes of all files together. A page has at most four gigabytes.
const MOST_BYTES: usize = 1 << 30;
/// Most files.
const MOST_FILES: usize = 20_000;
/// Most missing files that a message names.
const MOST_NAMED: usize = 40;

/// Files by their paths, within limits of number and size.
#[derive(Clone, Debug, Default)]
pub struct Files {
    memory: Memory,
    paths: BTreeSet<String>,
    bytes: usize,
}

/// Why a file or an archive was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilesError {
    /// There are too many files, or too large ones.
    TooMuch {
        /// The file that was too much.
        path: String,
    },
    /// An archive cannot be read.
    Damaged {
        /// Its name.
        archive: String,
        /// What is wrong with it.
        message: String,
    },
    /// An entry of an archive leads out of it.
    LeadsOut {
        /// Its name.
        archive: String,
        /// The path of the entry.
        entry: String,
    },
}

impl fmt::Display for FilesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilesError::TooMuch { path } => {
                let most = MOST_BYTES >> 20;
                write!(f, "{path}: at most {MOST_FILES} files and {most} MiB together can be opened")
            }
            FilesError::Damaged { archive, message } => {
                write!(f, "{archive}: a damaged zip archive: {message}")
            }
            FilesError::LeadsOut { archive, entry } => {
                write!(f, "{archive}: the entry {entry:?} leads out of the archive")
            }
        }
    }
}

impl std::error::Error for FilesError {}

/// Why a model among files cannot be opened.
#[derive(Clone, Debug)]
pub struct Unreadable {
    /// All that is wrong, each with its place.
    pub diagnostics: Diagnostics,
    /// Paths of the files that were looked for and are not there.
    pub missing: Vec<String>,
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.diagnostics)?;
        let (missing, count) = (&self.missing, self.missing.len());
        if count == 0 {
            return Ok(());
        }
        let (noun, verb) = if count == 1 { ("file", "is") } else { ("files", "are") };
        write!(f, "\n{count} {noun} {verb} missing; drop the folder with all of them, or these alone:")?;
        missing.iter().take(MOST_NAMED).try_for_each(|path| write!(f, "\n  {path}"))?;
        if count > MOST_NAMED { write!(f, "\n  and {} more", count - MOST_NAMED) } else { Ok(()) }
    }
}

impl std::error::Error for Unreadable {}

impl Files {
    /// No files yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, or replaces it. Folders in `path` are divided by `/`.
    ///
    /// # Errors
    /// There are too many files, or too large ones.
    pub fn insert(&mut self, path: &str, content: Vec<u8>) -> Result<(), FilesError> {
        self.bytes += content.len();
        if self.bytes > MOST_BYTES || self.paths.len() >= MOST_FILES {
            return Err(FilesError::TooMuch { path: path.to_owned() });
        }
        self.paths.insert(path.to_owned());
        self.memory.insert(path, content);
        Ok(())
    }

    /// Adds the files of a zip archive, in a folder of its name where `folder` is not empty.
    ///
    /// # Errors
    /// The archive is damaged, has entries that lead out of it, or unpacks to more than can be held.
    pub fn unpack(&mut self, folder: &str, archive: &[u8]) -> Result<(), FilesError> {
        let wrong = |error: &dyn fmt::Display| {
            let archive = if folder.is_empty() { "the dropped file" } else { folder };
            FilesError::Damaged { archive: archive.to_owned(), message: error.to_string() }
        };
        let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(|error| wrong(&error))?;
        for index in 0..archive.len() {
            let entry = archive.by_index(index).map_err(|error| wrong(&error))?;
            if entry.is_dir() {
                continue;
            }
            let Some(inside) = entry.enclosed_name() else {
                return Err(FilesError::LeadsOut {
                    archive: folder.to_owned(),
                    entry: entry.name().to_owned(),
                });
            };
            let inside = inside.to_string_lossy().replace('\\', "/");
            let left = (MOST_BYTES - self.bytes.min(MOST_BYTES)) as u64;
            let mut content = Vec::new();
            // Sizes in archives may lie.
            entry.take(left + 1).read_to_end(&mut content).map_err(|error| wrong(&error))?;
            let path = if folder.is_empty() { inside } else { format!("{folder}/{inside}") };
            self.insert(&path, content)?;
        }
        Ok(())
    }

    /// Adds a file, or what is in it where its name is that of a zip archive.
    ///
    /// # Errors
    /// As [`Files::insert`] and [`Files::unpack`].
    pub fn add(&mut self, path: &str, content: Vec<u8>) -> Result<(), FilesError> {
        if is_archive(path) {
            return self.unpack(path.rsplit_once('.').map_or(path, |(name, _)| name), &content);
        }
        self.insert(path, content)
    }

    /// Paths of the files that may be models, those that are nearest to the top first.
    pub fn models(&self) -> Vec<String> {
        let mut models: Vec<&String> = self.paths.iter().filter(|path| is_model(path)).collect();
        models.sort_by_key(|path| (path.matches('/').count(), !path.ends_with("scene.xml"), path.as_str()));
        models.into_iter().cloned().collect()
    }

    /// Number of files.
    pub fn len(&self) -> usize {
        self.paths.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.paths.is_empty()
    }

    /// Reads and compiles a model. A file without a folder stands for a missing one of its name.
    ///
    /// # Errors
    /// All that is wrong with it, each with file, line and column, and the files that are missing.
    pub fn load(&self, path: &str) -> Result<Loaded, Unreadable> {
        let loose = self.paths.iter().filter(|path| !path.contains('/'));
        let files = Noting {
            memory: self.memory.clone(),
            loose: loose.map(|path| (path.to_ascii_lowercase(), path.clone())).collect(),
            missing: Arc::default(),
        };
        let missing = files.missing.clone();
        Loader::default().files(files).load(path).map_err(|diagnostics| {
            let missing = missing.lock().unwrap_or_else(PoisonError::into_inner);
            Unreadable { diagnostics, missing: missing.iter().cloned().collect() }
        })
    }
}

/// Whether a file is a zip archive by its ending.
pub fn is_archive(path: &str) -> bool {
    ends_with_any(path, &[".zip", ".mjz"])
}

/// Whether a file may be a model by its ending.
pub fn is_model(path: &str) -> bool {
    ends_with_any(path, &[".xml", ".urdf", ".mjcf"])
}

fn ends_with_any(path: &str, endings: &[&str]) -> bool {
    let path = path.to_ascii_lowercase();
    endings.iter().any(|ending| path.ends_with(ending))
}

/// Files that remembers which were asked for in vain.
#[derive(Debug)]
struct Noting {
    memory: Memory,
    /// Files without a folder, by their names in lower case.
    loose: BTreeMap<String, String>,
    missing: Arc<Mutex<BTreeSet<String>>>,
}

impl Noting {
    /// The file of this path, or the one without a folder that stands for it.
    fn place(&self, path: &str) -> Option<String> {
        if self.memory.exists(path) {
            return Some(path.to_owned());
        }
        let name = path.rsplit('/').next().unwrap_or(path);
        self.loose.get(&name.to_ascii_lowercase()).cloned()
    }
}

impl FileProvider for Noting {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let Some(place) = self.place(path) else {
            self.missing.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_owned());
            return Err(FileError::NotFound);
        };
        self.memory.read(&place)
    }

    fn exists(&self, path: &str) -> bool {
        self.place(path).is_some()
    }
}
