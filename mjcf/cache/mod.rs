//! A cache of compiled models in a folder, keyed by the content of every input file.
//!
//! An entry is named by what was asked for: compiler, path, edits, limits. It lists every file that the compile read or
//! looked for, with a digest of its content, then the warnings, then the model. It holds when every file still has that
//! content: the digest is compared unless length, time of change and place on the disk are as they were when the file
//! was read, at least two seconds after its change.
//!
//! Beside models stand the meshes of files, processed, named by content and attributes: a model whose text has changed
//! is compiled from these.

mod entry;
mod reads;

pub(crate) use reads::{Noted, Reads};

use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::SystemTime;

use physics::Model;
use physics::model::binary;
use physics::plugin::Registry;

use crate::diagnostic::Diagnostics;
use crate::digest::{Digest, digest_parts, hex};
use crate::files::FileProvider;
use crate::loaded::Loaded;
use crate::mesh::CompiledMesh;
use crate::mesh::stored::{self, MeshStore};

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

    /// The cache file of this kind, named by the digest of its inputs.
    fn place(&self, kind: &str, parts: &[&[u8]]) -> PathBuf {
        let maker = [env!("ROBOHIVE_COMPILER").as_bytes(), kind.as_bytes()];
        let name = digest_parts(maker.into_iter().chain(parts.iter().copied()));
        self.folder.join(format!("{}.{kind}", hex(name)))
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

    /// The model that `request` describes, if none of its input files has changed: they are read while the
    /// model is.
    pub(crate) fn find_model(
        &self,
        request: &[&str],
        files: &(dyn FileProvider + Sync),
        registry: &Registry,
    ) -> Result<Loaded, Miss> {
        let path = self.entry(request);
        let mut file = File::open(&path).map_err(|_| Miss::Absent)?;
        let mut left = file.metadata().map_err(|_| Miss::Damaged)?.len();
        let (reads, warnings) = entry::read_list(&mut file, &mut left).ok_or(Miss::Damaged)?;
        let all_hold = || reads.iter().all(|(path, seen)| seen.holds(files, path));
        let start = file.stream_position().map_err(|_| Miss::Damaged)?;
        let again = |offset: u64| {
            let mut file = File::open(&path)?;
            file.seek(SeekFrom::Start(start + offset))?;
            Ok(Box::new(file) as Box<dyn Read>)
        };
        let mut model = || Model::read_parts(&mut file, left, Some(&again), registry);
        let (unchanged, model) = if left < binary::LARGE {
            (all_hold(), model())
        } else {
            std::thread::scope(|scope| {
                let unchanged = scope.spawn(all_hold);
                let model = model();
                (unchanged.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), model)
            })
        };
        let model = model.map_err(|_| Miss::Damaged)?;
        if !unchanged {
            return Err(Miss::Absent);
        }
        touch(&path);
        Ok(Loaded { model, warnings: Diagnostics::of(warnings) })
    }

    /// Keeps a model.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn keep_model(&self, request: &[&str], reads: Reads, loaded: &Loaded) -> std::io::Result<()> {
        let path = self.entry(request);
        self.put(&path, |file| entry::write(file, &reads, loaded))?;
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

impl MeshStore for Cache {
    fn find(&self, source: Digest) -> Option<CompiledMesh> {
        let path = self.place(MESH, &[&source]);
        let mesh = stored::from_bytes(&std::fs::read(&path).ok()?)?;
        touch(&path);
        Some(mesh)
    }

    fn keep(&self, source: Digest, mesh: &CompiledMesh) {
        // Where this fails the model cannot be kept either, which is reported.
        _ = self.put(&self.place(MESH, &[&source]), |file| file.write_all(&stored::to_bytes(mesh)));
    }
}

/// Notes when an entry was last used; a folder that may only be read serves as well.
fn touch(path: &Path) {
    _ = File::options().append(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
}
