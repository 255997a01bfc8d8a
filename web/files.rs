//! Files in memory: what a person dropped on a page, or what a script fetched.

use mjcf::files::{FileError, FileProvider, Memory};
use mjcf::{Loaded, Loader};
use std::collections::BTreeSet;
use std::io::{Cursor, Read};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};
use zip::ZipArchive;

/// Most bytes of all files together. A page has at most four gigabytes, and compiled models take their share.
const MOST_BYTES: usize = 1 << 29;
/// Most files.
const MOST_FILES: usize = 20_000;
/// Size limit of an unpacked archive, against zip bombs: 8 MiB plus 250 times the size of the archive.
const UNPACKED: usize = 8 << 20;
const UNPACKED_EACH: usize = 250;

/// Files by their paths.
#[wasm_bindgen]
#[derive(Default)]
pub struct Files {
    asked: Asked,
    paths: BTreeSet<String>,
    bytes: usize,
}

#[wasm_bindgen]
impl Files {
    /// No files yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Most bytes of all files together: what a script may ask before it reads a file.
    #[wasm_bindgen(js_name = mostBytes)]
    pub fn most_bytes() -> f64 {
        MOST_BYTES as f64
    }

    /// Adds a file, or replaces it. Folders in `path` are divided by `/`.
    ///
    /// # Errors
    /// There are too many files, or too large ones.
    pub fn add(&mut self, path: &str, content: &[u8]) -> Result<(), JsError> {
        self.insert(path, content.to_vec()).map_err(|error| JsError::new(&error))
    }

    /// Adds the files of a zip archive; `name` is what messages call it. Returns how many there are.
    ///
    /// # Errors
    /// The archive is damaged, has entries that lead out of it, or unpacks to more than a page can hold.
    #[wasm_bindgen(js_name = addArchive)]
    pub fn add_archive(&mut self, name: &str, archive: &[u8]) -> Result<usize, JsError> {
        self.unpack(name, archive).map_err(|error| JsError::new(&format!("{name}: {error}")))
    }

    /// Paths of all files.
    pub fn paths(&self) -> Vec<String> {
        self.paths.iter().cloned().collect()
    }

    /// Paths of the files that may be models, those that are nearest to the top first.
    pub fn models(&self) -> Vec<String> {
        let mut models: Vec<&String> = self.paths.iter().filter(|path| is_model(path)).collect();
        models.sort_by_key(|path| (path.matches('/').count(), !path.ends_with("scene.xml"), path.as_str()));
        models.into_iter().cloned().collect()
    }

    /// Number of files.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.paths.len()
    }

    /// Paths that the last model which was opened read in vain: it cannot be opened without them.
    #[wasm_bindgen(getter)]
    pub fn missing(&self) -> Vec<String> {
        self.asked.vain().read.iter().cloned().collect()
    }

    /// Paths at which it looked for a file before it tried another place. Whoever fetches files tries these first.
    #[wasm_bindgen(getter)]
    pub fn tried(&self) -> Vec<String> {
        self.asked.vain().tried.iter().cloned().collect()
    }

    /// Lets the file whose path ends most as `missing` does stand for it too, as where files were chosen without their
    /// folders. Returns the path of that file; nothing where no file has the same name, or several are as near.
    pub fn substitute(&mut self, missing: &str) -> Option<String> {
        let found = self.nearest(missing)?;
        let content = self.asked.memory.read(&found).ok()?;
        self.asked.memory.insert(missing, content);
        self.paths.insert(missing.to_owned());
        Some(found)
    }
}

impl Files {
    /// Adds a file; the error says which limit it exceeds.
    fn insert(&mut self, path: &str, content: Vec<u8>) -> Result<(), String> {
        self.bytes += content.len();
        if self.bytes > MOST_BYTES || self.paths.len() >= MOST_FILES {
            return Err(format!(
                "{path:?}: at most {MOST_FILES} files and {} MiB together can be opened",
                MOST_BYTES >> 20
            ));
        }
        self.paths.insert(path.to_owned());
        self.asked.memory.insert(path, content);
        Ok(())
    }

    fn unpack(&mut self, name: &str, archive: &[u8]) -> Result<usize, String> {
        let wrong = |error: &dyn std::fmt::Display| format!("a damaged zip archive: {error}");
        let most = archive.len().saturating_mul(UNPACKED_EACH).saturating_add(UNPACKED).min(MOST_BYTES);
        let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(|error| wrong(&error))?;
        let (mut unpacked, mut count) = (0, 0);
        for index in 0..archive.len() {
            let entry = archive.by_index(index).map_err(|error| wrong(&error))?;
            if entry.is_dir() {
                continue;
            }
            let Some(inside) = entry.enclosed_name() else {
                return Err(format!("the entry {:?} leads out of the archive", entry.name()));
            };
            let path = inside.to_string_lossy().replace('\\', "/");
            let mut content = Vec::new();
            // Sizes in archives may lie.
            let left = (most - unpacked) as u64;
            entry.take(left + 1).read_to_end(&mut content).map_err(|error| wrong(&error))?;
            unpacked += content.len();
            if unpacked > most {
                return Err(format!(
                    "unpacks to more than {} MiB, beyond what can be opened, or what an honest archive of its size holds",
                    most >> 20
                ));
            }
            self.insert(&path, content)?;
            count += 1;
        }
        match count {
            0 => Err(format!("the archive {name:?} holds no file")),
            _ => Ok(count),
        }
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
    pub(crate) fn load(&self, path: &str) -> Result<Loaded, String> {
        *self.asked.vain() = Vain::default();
        let loaded = Loader::default().files(self.asked.clone()).load(path);
        // What was found in another place was not looked for in vain.
        if loaded.is_ok() {
            *self.asked.vain() = Vain::default();
        }
        loaded.map_err(|errors| errors.to_string())
    }
}

/// Files in memory, and which others were asked for.
#[derive(Clone, Default)]
struct Asked {
    memory: Memory,
    vain: Arc<Mutex<Vain>>,
}

/// Paths at which there was nothing.
#[derive(Default)]
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

/// Whether a file may be a model by its ending.
fn is_model(path: &str) -> bool {
    [".xml", ".urdf", ".mjcf", ".rhm"].iter().any(|ending| path.to_ascii_lowercase().ends_with(ending))
}

/// Names and paths of the models of our own.
pub(crate) fn own_models() -> impl Iterator<Item = (String, &'static str)> {
    let models = assets::FILES.iter().map(|(path, _)| *path);
    models
        .filter(|path| path.ends_with(".xml") && !path.contains("/parts/"))
        .map(|path| (Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned(), path))
}

/// A model of our own.
pub(crate) fn load_own(name: &str) -> Result<Loaded, String> {
    let Some((_, path)) = own_models().find(|(own, _)| own == name) else {
        let names: Vec<String> = own_models().map(|(own, _)| own).collect();
        return Err(format!("{name} is no model of our own: {}", names.join(", ")));
    };
    let mut files = Memory::default();
    assets::FILES.iter().for_each(|(path, text)| files.insert(path, text.as_bytes()));
    Loader::default().files(files).load(path).map_err(|errors| errors.to_string())
}
