//! Compiled models kept in a folder, found again by the content of all they were made of.
//!
//! An entry is named by what was asked for: compiler, path, edits, limits. It lists every file that the compile read or
//! looked for, with a digest of its content (BLAKE3, so that other content with the same digest will not be met), then
//! the warnings, then the model. It holds when every file still has that content: the digest is compared unless length,
//! time of change and place on the disk are as they were when the file was read, at least two seconds after its change.
//!
//! Beside models stand the meshes of files, processed, named by content and attributes: a model whose text has changed
//! is compiled anew of these.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, SystemTime};

use physics::Model;
use physics::model::binary;

use crate::diagnostic::{Diagnostic, Diagnostics, Position, Severity};
use crate::files::{FileError, FileProvider, Stamp};
use crate::loader::Loaded;
use crate::mesh::{CompiledMesh, stored};

/// A folder of compiled models.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
    max_bytes: u64,
}

/// Kinds of entries, which their names end in.
const MODEL: &str = "rhc";
const MESH: &str = "rhmesh";

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
    Content(Digest, Option<Stamp>),
    Exists(bool),
}

/// A file that changed so shortly before it was read may have changed again without its time telling.
const SETTLED: Duration = Duration::from_secs(2);

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
        let request: Vec<&[u8]> = request.iter().map(|part| part.as_bytes()).collect();
        self.place(MODEL, &request)
    }

    /// The file of this kind named by all that it is made of.
    fn place(&self, kind: &str, parts: &[&[u8]]) -> PathBuf {
        let mut hasher = blake3::Hasher::new();
        for part in [env!("ROBOHIVE_COMPILER").as_bytes(), kind.as_bytes()].iter().chain(parts) {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        self.folder.join(format!("{}.{kind}", hasher.finalize().to_hex()))
    }

    /// The mesh kept for a file of this content and these attributes, or what `process` makes of it, kept.
    pub(crate) fn mesh<E>(
        &self,
        content: &[u8],
        attributes: &str,
        process: impl FnOnce() -> Result<CompiledMesh, E>,
    ) -> Result<CompiledMesh, E> {
        let path = self.place(MESH, &[content, attributes.as_bytes()]);
        if let Some(mesh) = std::fs::read(&path).ok().and_then(|bytes| stored::from_bytes(&bytes)) {
            touch(&path);
            return Ok(mesh);
        }
        let mesh = process()?;
        // Where this fails the model cannot be kept either, which is told.
        _ = self.put(&path, |file| file.write_all(&stored::to_bytes(&mesh)));
        Ok(mesh)
    }

    /// Writes an entry, which appears whole or not at all.
    fn put(&self, path: &Path, write: impl FnOnce(&mut File) -> std::io::Result<()>) -> std::io::Result<()> {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        std::fs::create_dir_all(&self.folder)?;
        let own = (std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let unfinished = path.with_extension(format!("{}-{}.part", own.0, own.1));
        let written = File::create(&unfinished).and_then(|mut file| {
            write(&mut file)?;
            let fits = file.stream_position()? <= self.max_bytes;
            if fits { std::fs::rename(&unfinished, path) } else { std::fs::remove_file(&unfinished) }
        });
        written.inspect_err(|_| _ = std::fs::remove_file(&unfinished))
    }

    /// The model that `request` describes, if all files it was made of are as they were: they are read while the
    /// model is.
    pub(crate) fn find(&self, request: &[&str], files: &(dyn FileProvider + Sync)) -> Result<Loaded, Miss> {
        let path = self.entry(request);
        let mut file = File::open(&path).map_err(|_| Miss::Absent)?;
        let mut left = file.metadata().map_err(|_| Miss::Damaged)?.len();
        let (reads, warnings) = read_list(&mut file, &mut left).ok_or(Miss::Damaged)?;
        let same = |(path, seen): (&String, &Seen)| match seen {
            Seen::Content(_, Some(stamp)) if files.stamp(path) == Some(*stamp) => true,
            Seen::Content(digest, _) => digest_now(files, path) == *digest,
            Seen::Exists(exists) => files.exists(path) == *exists,
        };
        let start = file.stream_position().map_err(|_| Miss::Damaged)?;
        let again = |offset: u64| {
            let mut file = File::open(&path)?;
            file.seek(SeekFrom::Start(start + offset))?;
            Ok(Box::new(file) as Box<dyn Read>)
        };
        let mut model = || Model::read_parts(&mut file, left, Some(&again));
        let (unchanged, model) = if left < binary::LARGE {
            (reads.iter().all(same), model())
        } else {
            std::thread::scope(|scope| {
                let unchanged = scope.spawn(|| reads.iter().all(same));
                let model = model();
                (unchanged.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), model)
            })
        };
        let model = model.map_err(|_| Miss::Damaged)?;
        if !unchanged {
            return Err(Miss::Absent);
        }
        touch(&path);
        let mut kept = Diagnostics::default();
        kept.list = warnings;
        Ok(Loaded { model, warnings: kept })
    }

    /// Keeps a model.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn keep(&self, request: &[&str], reads: Reads, loaded: &Loaded) -> std::io::Result<()> {
        let path = self.entry(request);
        self.put(&path, |file| write_entry(file, &reads, loaded))?;
        self.shrink(&path)
    }

    /// Removes the entries used longest ago, but not `newest`, until the rest fits.
    fn shrink(&self, newest: &Path) -> std::io::Result<()> {
        let mut entries = Vec::new();
        for entry in std::fs::read_dir(&self.folder)?.flatten() {
            let path = entry.path();
            let kept = path.extension().is_some_and(|kind| kind == MODEL || kind == MESH);
            if let (true, Ok(facts)) = (kept, entry.metadata()) {
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

/// Notes when an entry was last used; a folder that may only be read serves as well.
fn touch(path: &Path) {
    _ = File::options().append(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
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
        // Before the file is read, lest it change in between.
        let settled = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .unwrap_or_default()
            .saturating_sub(SETTLED);
        let stamp =
            self.files.stamp(path).filter(|stamp| i128::from(stamp.changed) < settled.as_nanos() as i128);
        let read = self.files.read(path);
        self.reads.borrow_mut().insert(path.to_owned(), Seen::Content(digest_of(&read), stamp));
        read
    }

    fn exists(&self, path: &str) -> bool {
        let exists = self.files.exists(path);
        self.reads.borrow_mut().entry(path.to_owned()).or_insert(Seen::Exists(exists));
        exists
    }
}

/// Writes a model: checksum and length of the list of files and warnings, the list, the model.
fn write_entry(file: &mut File, reads: &Reads, loaded: &Loaded) -> std::io::Result<()> {
    let mut list = Vec::new();
    put_count(&mut list, reads.len());
    for (path, seen) in reads {
        put_text(&mut list, path);
        match seen {
            Seen::Content(Some(digest), stamp) => {
                list.push(if stamp.is_some() { 4 } else { 2 });
                list.extend(digest);
                if let Some(stamp) = stamp {
                    list.extend(
                        [stamp.length, stamp.changed as u64, stamp.place]
                            .map(u64::to_le_bytes)
                            .as_flattened(),
                    );
                }
            }
            Seen::Content(None, _) => list.push(3),
            Seen::Exists(exists) => list.push(u8::from(*exists)),
        }
    }
    put_count(&mut list, loaded.warnings.list.len());
    loaded.warnings.list.iter().for_each(|warning| put_warning(&mut list, warning));
    let mut out = BufWriter::with_capacity(1 << 16, file);
    out.write_all(&binary::checksum(&list).to_le_bytes())?;
    out.write_all(&(list.len() as u64).to_le_bytes())?;
    out.write_all(&list)?;
    loaded.model.write(&mut out)?;
    out.flush()
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
            2 => Seen::Content(Some(take_digest(list)?), None),
            4 => Seen::Content(Some(take_digest(list)?), Some(take_stamp(list)?)),
            3 => Seen::Content(None, None),
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

fn take_digest(from: &mut &[u8]) -> Option<[u8; 32]> {
    take(from, 32)?.try_into().ok()
}

fn take_stamp(from: &mut &[u8]) -> Option<Stamp> {
    let mut word = || Some(u64::from_le_bytes(take(from, 8)?.try_into().ok()?));
    Some(Stamp { length: word()?, changed: word()? as i64, place: word()? })
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
