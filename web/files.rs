//! Files in memory: what a person dropped on a page, or what a script fetched.

use mjcf::files::Memory;
use mjcf::{Loaded, Loader};
use std::io::{Cursor, Read};
use std::path::Path;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};
use zip::ZipArchive;

/// Most bytes of all files together. A page has at most four gigabytes.
const MOST_BYTES: usize = 1 << 30;
/// Most files.
const MOST_FILES: usize = 20_000;

/// Files by their paths.
#[wasm_bindgen]
#[derive(Default)]
pub struct Files {
    memory: Memory,
    paths: Vec<String>,
    bytes: usize,
}

#[wasm_bindgen]
impl Files {
    /// No files yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, or replaces it. Folders in `path` are divided by `/`.
    ///
    /// # Errors
    /// There are too many files, or too large ones.
    pub fn add(&mut self, path: &str, content: &[u8]) -> Result<(), JsError> {
        self.insert(path, content.to_vec()).map_err(|error| JsError::new(&error))
    }

    /// Adds the files of a zip archive, in a folder of its name where `folder` is not empty.
    ///
    /// # Errors
    /// The archive is damaged, has entries that lead out of it, or unpacks to more than a page can hold.
    #[wasm_bindgen(js_name = addArchive)]
    pub fn add_archive(&mut self, folder: &str, archive: &[u8]) -> Result<(), JsError> {
        self.unpack(folder, archive).map_err(|error| JsError::new(&error))
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
}

impl Files {
    /// Adds a file; the error says which limit it exceeds.
    pub(crate) fn insert(&mut self, path: &str, content: Vec<u8>) -> Result<(), String> {
        self.bytes += content.len();
        if self.bytes > MOST_BYTES || self.paths.len() >= MOST_FILES {
            return Err(format!(
                "{path}: at most {MOST_FILES} files and {} MiB together can be opened",
                MOST_BYTES >> 20
            ));
        }
        if !self.paths.iter().any(|known| known == path) {
            self.paths.push(path.to_owned());
        }
        self.memory.insert(path, content);
        Ok(())
    }

    /// Unpacks an archive.
    pub(crate) fn unpack(&mut self, folder: &str, archive: &[u8]) -> Result<(), String> {
        let wrong = |error: &dyn std::fmt::Display| format!("{folder}: a damaged zip archive: {error}");
        let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(|error| wrong(&error))?;
        for index in 0..archive.len() {
            let entry = archive.by_index(index).map_err(|error| wrong(&error))?;
            if entry.is_dir() {
                continue;
            }
            let Some(inside) = entry.enclosed_name() else {
                return Err(format!("{folder}: the entry {:?} leads out of the archive", entry.name()));
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

    /// Reads and compiles a model.
    pub(crate) fn load(&self, path: &str) -> Result<Loaded, String> {
        Loader::default().files(self.memory.clone()).load(path).map_err(|errors| errors.to_string())
    }
}

/// Whether a file may be a model by its ending.
fn is_model(path: &str) -> bool {
    [".xml", ".urdf", ".mjcf"].iter().any(|ending| path.to_ascii_lowercase().ends_with(ending))
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
