//! Where a model's files come from, and how MJCF paths combine.
//!
//! Paths are strings with `/` on every platform, so a model reads alike from disk and from memory (the
//! browser). Paths are combined as MuJoCo combines them: an absolute right side wins, `.` and
//! `dir/..` are folded without asking the disk.
//!
//! ```
//! use robohive_mjcf::{Loader, files::Memory};
//!
//! let mut files = Memory::default();
//! files.insert("robot/arm.xml", *b"<mujoco><worldbody><include file='geom.xml'/></worldbody></mujoco>");
//! files.insert("robot/geom.xml", *b"<mujoco><geom name='ball' size='0.1'/></mujoco>");
//! let loaded = Loader::default().files(files).load("robot/arm.xml")?;
//! assert_eq!(loaded.model.ngeom, 1);
//! # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{File, Metadata};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::escape::Escaped;

/// Why a file could not be had.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileError {
    /// No file has this path.
    NotFound,
    /// The path leads outside the directory that the model may read.
    OutOfReach,
    /// The path names a directory or a device.
    NotAFile,
    /// The file has this many bytes, more than the provider hands out.
    TooLarge(u64),
    /// Any other failure, in the words of the operating system.
    Other(String),
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileError::NotFound => f.write_str("the file does not exist"),
            FileError::OutOfReach => {
                f.write_str("the path leads outside the directory that this model may read")
            }
            FileError::NotAFile => f.write_str("the path is not that of a regular file"),
            FileError::TooLarge(bytes) => write!(f, "the file has {bytes} bytes, more than may be read"),
            FileError::Other(reason) => write!(f, "{}", Escaped(reason)),
        }
    }
}

impl std::error::Error for FileError {}

/// What differs once a file was written again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// Bytes of the file.
    pub length: u64,
    /// When its content or its place last changed, in nanoseconds since 1970.
    pub changed: i64,
    /// Its place on the disk, where the system tells it.
    pub place: u64,
}

/// A source of bytes by path.
pub trait FileProvider {
    /// The content of the file at `path`.
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError>;

    /// The content of the file at `path` piece by piece, and its length.
    fn open(&self, path: &str) -> Result<(Box<dyn Read>, u64), FileError> {
        let bytes = self.read(path)?;
        let length = bytes.len() as u64;
        Ok((Box::new(Cursor::new(bytes)), length))
    }

    /// Whether `read` would find a file at `path`.
    fn exists(&self, path: &str) -> bool;

    /// The stamp of the file at `path`; `None` when there is no file, or no telling when it changed.
    fn stamp(&self, _path: &str) -> Option<Stamp> {
        None
    }
}

/// Files of the machine, within one directory.
#[derive(Debug, Clone)]
pub struct Disk {
    root: Option<PathBuf>,
    max_bytes: u64,
}

impl Disk {
    /// The whole file system: models of RoboHive climb several directories to shared assets.
    pub fn everywhere() -> Self {
        Self { root: None, max_bytes: 1 << 30 }
    }

    /// Only files that stand, symbolic links resolved, inside `root`.
    pub fn within(root: impl Into<PathBuf>) -> Self {
        Self { root: Some(root.into()), max_bytes: 1 << 30 }
    }

    fn reach(&self, path: &str) -> Result<PathBuf, FileError> {
        let Some(root) = &self.root else { return Ok(path.into()) };
        let found = Path::new(path).canonicalize().map_err(io_error)?;
        let root = root.canonicalize().map_err(io_error)?;
        if found.starts_with(root) { Ok(found) } else { Err(FileError::OutOfReach) }
    }

    /// A file that may be read, and what the system says of it.
    fn find(&self, path: &str) -> Result<(PathBuf, Metadata), FileError> {
        let path = self.reach(path)?;
        let facts = path.metadata().map_err(io_error)?;
        if !facts.is_file() {
            return Err(FileError::NotAFile);
        }
        if facts.len() > self.max_bytes {
            return Err(FileError::TooLarge(facts.len()));
        }
        Ok((path, facts))
    }
}

impl FileProvider for Disk {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let (path, facts) = self.find(path)?;
        let mut file = File::open(path).map_err(io_error)?;
        // Into its final place: a vector would be copied.
        let mut bytes: Arc<[u8]> = std::iter::repeat_n(0, facts.len() as usize).collect();
        file.read_exact(Arc::make_mut(&mut bytes)).map_err(io_error)?;
        match file.read(&mut [0]).map_err(io_error)? {
            0 => Ok(bytes),
            _ => Err(FileError::Other("the file grew while it was read".into())),
        }
    }

    fn open(&self, path: &str) -> Result<(Box<dyn Read>, u64), FileError> {
        let (path, facts) = self.find(path)?;
        let file = File::open(path).map_err(io_error)?;
        Ok((Box::new(file), facts.len()))
    }

    fn exists(&self, path: &str) -> bool {
        self.reach(path).is_ok_and(|p| p.is_file())
    }

    fn stamp(&self, path: &str) -> Option<Stamp> {
        let (_, facts) = self.find(path).ok()?;
        let (changed, place) = change(&facts)?;
        Some(Stamp { length: facts.len(), changed, place })
    }
}

/// When a file last changed and where it is. Programs can set the time of writing back, this one not.
#[cfg(unix)]
fn change(facts: &Metadata) -> Option<(i64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((facts.ctime().checked_mul(1_000_000_000)?.checked_add(facts.ctime_nsec())?, facts.ino()))
}

#[cfg(not(unix))]
fn change(facts: &Metadata) -> Option<(i64, u64)> {
    let since = facts.modified().ok()?.duration_since(std::time::UNIX_EPOCH).ok()?;
    Some((i64::try_from(since.as_nanos()).ok()?, 0))
}

fn io_error(error: std::io::Error) -> FileError {
    match error.kind() {
        std::io::ErrorKind::NotFound | std::io::ErrorKind::NotADirectory => FileError::NotFound,
        _ => FileError::Other(error.to_string()),
    }
}

/// Files held in memory, by folded path.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    files: BTreeMap<String, Arc<[u8]>>,
}

impl Memory {
    /// Adds or replaces a file.
    pub fn insert(&mut self, path: impl AsRef<str>, content: impl Into<Arc<[u8]>>) {
        self.files.insert(fold(path.as_ref()), content.into());
    }
}

impl FileProvider for Memory {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        self.files.get(&fold(path)).cloned().ok_or(FileError::NotFound)
    }

    fn exists(&self, path: &str) -> bool {
        self.files.contains_key(&fold(path))
    }
}

/// One file of memory in front of others: a text that is to be read where it will stand.
#[derive(Debug, Clone)]
pub struct Overlay<F> {
    files: F,
    path: String,
    content: Arc<[u8]>,
}

impl<F: FileProvider> Overlay<F> {
    /// `content` at `path`, and `files` everywhere else.
    pub fn new(files: F, path: impl AsRef<str>, content: impl Into<Arc<[u8]>>) -> Self {
        Overlay { files, path: fold(path.as_ref()), content: content.into() }
    }
}

impl<F: FileProvider> FileProvider for Overlay<F> {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        if fold(path) == self.path { Ok(self.content.clone()) } else { self.files.read(path) }
    }

    fn open(&self, path: &str) -> Result<(Box<dyn Read>, u64), FileError> {
        match fold(path) == self.path {
            true => Ok((Box::new(Cursor::new(self.content.clone())), self.content.len() as u64)),
            false => self.files.open(path),
        }
    }

    fn exists(&self, path: &str) -> bool {
        fold(path) == self.path || self.files.exists(path)
    }

    fn stamp(&self, path: &str) -> Option<Stamp> {
        if fold(path) == self.path { None } else { self.files.stamp(path) }
    }
}

/// The path of `file` seen from directory `dir`, folded.
pub(crate) fn join(dir: &str, file: &str) -> String {
    if dir.is_empty() || is_absolute(file) {
        return fold(file);
    }
    fold(&format!("{}/{file}", dir.trim_end_matches('/')))
}

/// Whether `path` starts at a root.
pub(crate) fn is_absolute(path: &str) -> bool {
    let drive = |b: &[u8]| b.len() > 2 && b[0].is_ascii_alphabetic() && b[1] == b':' && is_separator(b[2]);
    path.bytes().next().is_some_and(is_separator) || drive(path.as_bytes())
}

/// The last component of `path`.
pub(crate) fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn is_separator(byte: u8) -> bool {
    matches!(byte, b'/' | b'\\')
}

/// `path` with `/` between components and without `.`, empty and `dir/..` components.
pub(crate) fn fold(path: &str) -> String {
    let root = if path.bytes().next().is_some_and(is_separator) { "/" } else { "" };
    let mut kept: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." if kept.last().is_some_and(|last| *last != "..") => {
                kept.pop();
            }
            _ => kept.push(part),
        }
    }
    format!("{root}{}", kept.join("/"))
}

/// How a text in directory `dir` names `file`; `None` when one of them starts at a root and the other does not, or `dir`
/// climbs above where both start.
pub fn relative(dir: &str, file: &str) -> Option<String> {
    let (dir, file) = (fold(dir), fold(file));
    if is_absolute(&dir) != is_absolute(&file) && !dir.is_empty() {
        return None;
    }
    let parts =
        |path: &str| path.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect::<Vec<_>>();
    let (dir, parts) = (parts(&dir), parts(&file));
    let shared = dir.iter().zip(&parts).take_while(|(a, b)| a == b).count();
    if dir[shared..].iter().any(|part| part == "..") {
        return None;
    }
    let up = std::iter::repeat_n("..", dir.len() - shared);
    let down = parts[shared..].iter().map(String::as_str);
    let relative = up.chain(down).collect::<Vec<_>>().join("/");
    // From the top, a file that starts at a root keeps it.
    Some(if dir.is_empty() && is_absolute(&file) { file } else { relative })
}
