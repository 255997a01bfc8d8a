//! Files in memory: what a person dropped on a window or a page, or what a script fetched.

use mjcf::diagnostic::Diagnostics;
use mjcf::files::{FileError, FileProvider, Memory};
use mjcf::{Loaded, Loader};
use std::collections::BTreeSet;
use std::fmt;
use std::io::{Cursor, Read};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use zip::ZipArchive;

/// Most bytes of all files together. A page has at most four gigabytes, of which compiled models take their share.
pub const MOST_BYTES: usize = if cfg!(target_arch = "wasm32") { 1 << 29 } else { 1 << 30 };
/// Most files.
const MOST_FILES: usize = 20_000;
/// Most missing files that a message names.
const MOST_NAMED: usize = 40;
/// Size limit of an unpacked archive, against zip bombs: 8 MiB plus 250 times the size of the archive.
const UNPACKED: usize = 8 << 20;
const UNPACKED_EACH: usize = 250;

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
    /// An archive unpacks to more than can be held, or than an honest one of its size does.
    Bomb {
        /// Its name.
        archive: String,
        /// Most bytes that it may unpack to.
        most: usize,
    },
    /// An archive holds no file.
    Empty {
        /// Its name.
        archive: String,
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
            FilesError::Bomb { archive, most } => write!(
                f,
                "{archive}: unpacks to more than {} MiB, beyond what can be opened, or what an honest archive of its size holds",
                most >> 20
            ),
            FilesError::Empty { archive } => write!(f, "{archive}: the archive holds no file"),
        }
    }
}

impl std::error::Error for FilesError {}

/// Why a model among files cannot be opened.
#[derive(Clone, Debug)]
pub struct Unreadable {
    /// All that is wrong, each with its place.
    pub diagnostics: Diagnostics,
    /// Paths of the files that were read and are not there: the model cannot be opened without them.
    pub missing: Vec<String>,
    /// Paths at which a file was looked for before another place was tried. Whoever fetches files tries these first.
    pub tried: Vec<String>,
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

    /// Adds the files of a zip archive into `folder`, or at the top where that is empty; `name` is what messages call it.
    /// Returns how many there are.
    ///
    /// # Errors
    /// The archive is damaged or empty, has entries that lead out of it, or unpacks to more than can be held.
    pub fn unpack(&mut self, name: &str, folder: &str, archive: &[u8]) -> Result<usize, FilesError> {
        let archive_name = || name.to_owned();
        let wrong = |error: &dyn fmt::Display| FilesError::Damaged {
            archive: archive_name(),
            message: error.to_string(),
        };
        let most = archive.len().saturating_mul(UNPACKED_EACH).saturating_add(UNPACKED).min(MOST_BYTES);
        let mut zip = ZipArchive::new(Cursor::new(archive)).map_err(|error| wrong(&error))?;
        let (mut unpacked, mut count) = (0, 0);
        for index in 0..zip.len() {
            let entry = zip.by_index(index).map_err(|error| wrong(&error))?;
            if entry.is_dir() {
                continue;
            }
            let Some(inside) = entry.enclosed_name() else {
                return Err(FilesError::LeadsOut { archive: archive_name(), entry: entry.name().to_owned() });
            };
            let inside = inside.to_string_lossy().replace('\\', "/");
            let mut content = Vec::new();
            // Sizes in archives may lie.
            let left = (most - unpacked) as u64;
            entry.take(left + 1).read_to_end(&mut content).map_err(|error| wrong(&error))?;
            unpacked += content.len();
            if unpacked > most {
                return Err(FilesError::Bomb { archive: archive_name(), most });
            }
            let path = if folder.is_empty() { inside } else { format!("{folder}/{inside}") };
            self.insert(&path, content)?;
            count += 1;
        }
        if count == 0 { Err(FilesError::Empty { archive: archive_name() }) } else { Ok(count) }
    }

    /// Adds a file, or what is in it, in a folder of its name, where that is the name of a zip archive.
    ///
    /// # Errors
    /// As [`Files::insert`] and [`Files::unpack`].
    pub fn add(&mut self, path: &str, content: Vec<u8>) -> Result<(), FilesError> {
        if is_archive(path) {
            let folder = path.rsplit_once('.').map_or(path, |(name, _)| name);
            return self.unpack(path, folder, &content).map(drop);
        }
        self.insert(path, content)
    }

    /// Paths of all files.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.paths.iter().map(String::as_str)
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

    /// Lets the file whose path ends most as `missing` does stand for it too, as where files were chosen without their
    /// folders. Returns the path of that file; nothing where no file has the same name, or several are as near.
    pub fn substitute(&mut self, missing: &str) -> Option<String> {
        let found = self.nearest(missing)?;
        let content = self.memory.read(&found).ok()?;
        self.memory.insert(missing, content);
        self.paths.insert(missing.to_owned());
        Some(found)
    }

    /// The only file with most components of its path, from the last on, as `missing` has them.
    fn nearest(&self, missing: &str) -> Option<String> {
        let shared = |path: &str| {
            let pairs = path.rsplit('/').zip(missing.rsplit(['/', '\\']));
            pairs.take_while(|(a, b)| a.eq_ignore_ascii_case(b)).count()
        };
        let most = self.paths.iter().map(|path| shared(path)).max().filter(|&most| most > 0)?;
        let mut nearest = self.paths.iter().filter(|path| shared(path) == most);
        nearest.next().filter(|_| nearest.next().is_none()).cloned()
    }

    /// Reads and compiles a model.
    ///
    /// # Errors
    /// All that is wrong with it, each with file, line and column, and the files that are missing.
    pub fn load(&self, path: &str) -> Result<Loaded, Unreadable> {
        let asked = Asked { memory: self.memory.clone(), vain: Arc::default() };
        let vain = asked.vain.clone();
        Loader::default().files(asked).load(path).map_err(|diagnostics| {
            let vain = vain.lock().unwrap_or_else(PoisonError::into_inner);
            let list = |paths: &BTreeSet<String>| paths.iter().cloned().collect();
            Unreadable { diagnostics, missing: list(&vain.read), tried: list(&vain.tried) }
        })
    }

    /// Reads and compiles a model; for a file that is missing the one of its name stands, as [`Files::substitute`] chooses it.
    ///
    /// # Errors
    /// As [`Files::load`].
    pub fn load_gathered(&self, path: &str) -> Result<Loaded, Unreadable> {
        let mut files = self.clone();
        loop {
            let error = match files.load(path) {
                Ok(loaded) => return Ok(loaded),
                Err(error) => error,
            };
            if error.missing.iter().filter(|missing| files.substitute(missing).is_some()).count() == 0 {
                return Err(error);
            }
        }
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

/// Files in memory, and which others were asked for.
#[derive(Debug)]
struct Asked {
    memory: Memory,
    vain: Arc<Mutex<Vain>>,
}

/// Paths at which there was nothing.
#[derive(Debug, Default)]
struct Vain {
    read: BTreeSet<String>,
    tried: BTreeSet<String>,
}

impl Asked {
    fn vain(&self) -> MutexGuard<'_, Vain> {
        self.vain.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl FileProvider for Asked {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let read = self.memory.read(path);
        if read.is_err() {
            self.vain().read.insert(path.to_owned());
        }
        read
    }

    fn exists(&self, path: &str) -> bool {
        let exists = self.memory.exists(path);
        if !exists {
            self.vain().tried.insert(path.to_owned());
        }
        exists
    }
}
