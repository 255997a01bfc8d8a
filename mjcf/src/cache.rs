//! Compiled models kept in a folder, found again by the content of all they were made of.
//!
//! An entry is named by what was asked for: compiler, path, edits, limits. It lists every file that the compile read or
//! looked for, with a digest of its content (BLAKE3, so that other content with the same digest will not be met), then
//! the warnings, then the model. It holds when every file still has that content.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::SystemTime;

use physics::Model;
use physics::model::binary;

use crate::diagnostic::{Diagnostic, Diagnostics, Position, Severity};
use crate::files::{FileError, FileProvider};
use crate::loader::Loaded;

/// A folder of compiled models.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
    max_bytes: u64,
}

/// Why an entry is not used.
pub(crate) enum Miss {
    /// There is none, or a file has changed.
    Absent,
    /// The entry cannot be read.
    Damaged,
}

/// Content of a file: `None` when there is none to be had.
pub(crate) type Digest = Option<[u8; 32]>;

/// What was read and looked for.
pub(crate) type Reads = BTreeMap<String, Seen>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Seen {
    Content(Digest),
    Exists(bool),
}

impl Cache {
    /// Keeps models in `folder`, which is made when the first is written; at most 4 GiB of them.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Cache { folder: folder.into(), max_bytes: 4 << 30 }
    }

    /// Bounds the size of the folder: beyond it, the models used longest ago go.
    pub fn max_bytes(mut self, bytes: u64) -> Self {
        self.max_bytes = bytes;
        self
    }

    /// Where the model that `request` describes is kept.
    fn entry(&self, request: &[&str]) -> PathBuf {
        let mut hasher = blake3::Hasher::new();
        for part in [env!("ROBOHIVE_COMPILER")].iter().chain(request) {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part.as_bytes());
        }
        self.folder.join(format!("{}.rhc", hasher.finalize().to_hex()))
    }

    /// The model that `request` describes, if all files it was made of are as they were: they are read while the
    /// model is.
    pub(crate) fn find(&self, request: &[&str], files: &(dyn FileProvider + Sync)) -> Result<Loaded, Miss> {
        let path = self.entry(request);
        let mut file = std::fs::File::options().read(true).open(&path).map_err(|_| Miss::Absent)?;
        let mut left = file.metadata().map_err(|_| Miss::Damaged)?.len();
        let (reads, warnings) = read_list(&mut file, &mut left).ok_or(Miss::Damaged)?;
        let same = |(path, seen): (&String, &Seen)| match seen {
            Seen::Content(digest) => digest_now(files, path) == *digest,
            Seen::Exists(exists) => files.exists(path) == *exists,
        };
        let (unchanged, model) = std::thread::scope(|scope| {
            let unchanged = scope.spawn(|| reads.iter().all(same));
            let model = Model::read(&mut file, left);
            (unchanged.join().unwrap_or(false), model)
        });
        let model = model.map_err(|_| Miss::Damaged)?;
        if !unchanged {
            return Err(Miss::Absent);
        }
        // When it was last used; a folder that may only be read serves as well.
        _ = std::fs::File::options()
            .append(true)
            .open(&path)
            .and_then(|file| file.set_modified(SystemTime::now()));
        Ok(Loaded { model, warnings: Diagnostics { list: warnings, dropped: 0 } })
    }

    /// Keeps a model. The entry appears whole or not at all.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn keep(&self, request: &[&str], reads: Reads, loaded: &Loaded) -> std::io::Result<()> {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        let bytes = write_entry(&reads, loaded);
        if bytes.len() as u64 > self.max_bytes {
            return Ok(());
        }
        std::fs::create_dir_all(&self.folder)?;
        let path = self.entry(request);
        let own = (std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let unfinished = path.with_extension(format!("{}-{}.part", own.0, own.1));
        std::fs::write(&unfinished, bytes).and_then(|()| std::fs::rename(&unfinished, &path)).inspect_err(
            |_| {
                _ = std::fs::remove_file(&unfinished);
            },
        )?;
        self.shrink(&path)
    }

    /// Removes the entries used longest ago, but not `newest`, until the rest fits.
    fn shrink(&self, newest: &Path) -> std::io::Result<()> {
        let mut entries = Vec::new();
        for entry in std::fs::read_dir(&self.folder)?.flatten() {
            let path = entry.path();
            if let (true, Ok(facts)) = (path.extension().is_some_and(|e| e == "rhc"), entry.metadata()) {
                entries.push((facts.modified().unwrap_or(SystemTime::UNIX_EPOCH), facts.len(), path));
            }
        }
        entries.sort();
        let mut total: u64 = entries.iter().map(|(_, bytes, _)| bytes).sum();
        for (_, bytes, path) in entries.iter().filter(|(_, _, path)| path != newest) {
            if total <= self.max_bytes {
                break;
            }
            // Another process may have removed it already.
            _ = std::fs::remove_file(path);
            total -= bytes;
        }
        Ok(())
    }
}

fn digest_of(read: &Result<Arc<[u8]>, FileError>) -> Digest {
    read.as_ref().ok().map(|bytes| *blake3::hash(bytes).as_bytes())
}

/// The digest of the file at `path`, read piece by piece.
fn digest_now(files: &dyn FileProvider, path: &str) -> Digest {
    let (source, _) = files.open(path).ok()?;
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(source).ok()?;
    Some(*hasher.finalize().as_bytes())
}

/// Files whose reading is noted.
pub(crate) struct Noted<'a> {
    files: &'a dyn FileProvider,
    reads: RefCell<Reads>,
}

impl<'a> Noted<'a> {
    pub(crate) fn new(files: &'a dyn FileProvider) -> Self {
        Noted { files, reads: RefCell::default() }
    }

    pub(crate) fn reads(self) -> Reads {
        self.reads.into_inner()
    }
}

impl FileProvider for Noted<'_> {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let read = self.files.read(path);
        self.reads.borrow_mut().insert(path.to_owned(), Seen::Content(digest_of(&read)));
        read
    }

    fn exists(&self, path: &str) -> bool {
        let exists = self.files.exists(path);
        self.reads.borrow_mut().entry(path.to_owned()).or_insert(Seen::Exists(exists));
        exists
    }
}

/// An entry: checksum and length of the list of files and warnings, the list, the model.
fn write_entry(reads: &Reads, loaded: &Loaded) -> Vec<u8> {
    let mut list = Vec::new();
    put_count(&mut list, reads.len());
    for (path, seen) in reads {
        put_text(&mut list, path);
        match seen {
            Seen::Content(Some(digest)) => {
                list.push(2);
                list.extend(digest);
            }
            Seen::Content(None) => list.push(3),
            Seen::Exists(exists) => list.push(u8::from(*exists)),
        }
    }
    put_count(&mut list, loaded.warnings.list.len());
    loaded.warnings.list.iter().for_each(|warning| put_warning(&mut list, warning));
    let mut out = Vec::new();
    out.extend(binary::checksum(&list).to_le_bytes());
    put_count(&mut out, list.len());
    out.extend(list);
    out.extend(loaded.model.to_bytes());
    out
}

/// The list at the start of an entry of `left` bytes, which become those of the model.
fn read_list(source: &mut impl Read, left: &mut u64) -> Option<(Reads, Vec<Diagnostic>)> {
    let mut head = [0; 16];
    source.read_exact(&mut head).ok()?;
    let (checksum, mut length) = head.split_at(8);
    let length = take_count(&mut length)?;
    *left = left.checked_sub(16)?.checked_sub(length as u64)?;
    let mut list = vec![0; length];
    source.read_exact(&mut list).ok()?;
    if binary::checksum(&list).to_le_bytes() != *checksum {
        return None;
    }
    let list = &mut &list[..];
    let mut reads = Reads::new();
    for _ in 0..take_count(list)? {
        let path = take_text(list)?;
        let seen = match take(list, 1)?[0] {
            2 => Seen::Content(Some(take(list, 32)?.try_into().ok()?)),
            3 => Seen::Content(None),
            exists => Seen::Exists(exists == 1),
        };
        reads.insert(path, seen);
    }
    let mut warnings = Vec::new();
    for _ in 0..take_count(list)? {
        warnings.push(take_warning(list)?);
    }
    Some((reads, warnings))
}

fn put_count(out: &mut Vec<u8>, n: usize) {
    out.extend((n as u64).to_le_bytes());
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    put_count(out, text.len());
    out.extend(text.as_bytes());
}

fn put_position(out: &mut Vec<u8>, position: &Position) {
    put_text(out, &position.path);
    put_count(out, position.line);
    put_count(out, position.column);
}

fn put_warning(out: &mut Vec<u8>, warning: &Diagnostic) {
    put_text(out, &warning.message);
    put_count(out, usize::from(warning.position.is_some()));
    warning.position.iter().for_each(|position| put_position(out, position));
    put_count(out, warning.include_chain.len());
    warning.include_chain.iter().for_each(|position| put_position(out, position));
    put_count(out, usize::from(warning.suggestion.is_some()));
    warning.suggestion.iter().for_each(|text| put_text(out, text));
}

fn take<'a>(from: &mut &'a [u8], n: usize) -> Option<&'a [u8]> {
    let (taken, rest) = from.split_at_checked(n)?;
    *from = rest;
    Some(taken)
}

fn take_count(from: &mut &[u8]) -> Option<usize> {
    usize::try_from(u64::from_le_bytes(take(from, 8)?.try_into().ok()?)).ok()
}

fn take_text(from: &mut &[u8]) -> Option<String> {
    let length = take_count(from)?;
    String::from_utf8(take(from, length)?.to_vec()).ok()
}

fn take_position(from: &mut &[u8]) -> Option<Position> {
    Some(Position { path: take_text(from)?, line: take_count(from)?, column: take_count(from)? })
}

fn take_warning(from: &mut &[u8]) -> Option<Diagnostic> {
    let message = take_text(from)?;
    let position = if take_count(from)? == 1 { Some(take_position(from)?) } else { None };
    let mut include_chain = Vec::new();
    for _ in 0..take_count(from)? {
        include_chain.push(take_position(from)?);
    }
    let suggestion = if take_count(from)? == 1 { Some(take_text(from)?) } else { None };
    Some(Diagnostic { severity: Severity::Warning, message, position, include_chain, suggestion })
}
