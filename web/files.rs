//! Files in memory as JavaScript holds them.

use mjcf::Loaded;
use mjcf::diagnostic::Diagnostics;
use std::sync::{Mutex, MutexGuard, PoisonError};
use viewer::MOST_BYTES;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Files by their paths.
#[wasm_bindgen]
#[derive(Default)]
pub struct Files {
    files: viewer::Files,
    vain: Mutex<Vain>,
}

/// What the last model that was opened asked for in vain.
#[derive(Default)]
struct Vain {
    missing: Vec<String>,
    tried: Vec<String>,
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
        Ok(self.files.insert(path, content.to_vec())?)
    }

    /// Adds the files of a zip archive; `name` is what messages call it. Returns how many there are.
    ///
    /// # Errors
    /// The archive is damaged or empty, has entries that lead out of it, or unpacks to more than a page can hold.
    #[wasm_bindgen(js_name = addArchive)]
    pub fn add_archive(&mut self, name: &str, archive: &[u8]) -> Result<usize, JsError> {
        Ok(self.files.unpack(name, "", archive)?)
    }

    /// Paths of all files.
    pub fn paths(&self) -> Vec<String> {
        self.files.paths().map(str::to_owned).collect()
    }

    /// Paths of the files that may be models, those that are nearest to the top first.
    pub fn models(&self) -> Vec<String> {
        self.files.models()
    }

    /// Number of files.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.files.len()
    }

    /// Paths that the last model which was opened read in vain: it cannot be opened without them.
    #[wasm_bindgen(getter)]
    pub fn missing(&self) -> Vec<String> {
        self.vain().missing.clone()
    }

    /// Paths at which it looked for a file before it tried another place. Whoever fetches files tries these first.
    #[wasm_bindgen(getter)]
    pub fn tried(&self) -> Vec<String> {
        self.vain().tried.clone()
    }

    /// Lets the file whose path ends most as `missing` does stand for it too, as where files were chosen without their
    /// folders. Returns the path of that file; nothing where no file has the same name, or several are as near.
    pub fn substitute(&mut self, missing: &str) -> Option<String> {
        self.files.substitute(missing)
    }
}

impl Files {
    /// The files.
    pub fn all(&self) -> &viewer::Files {
        &self.files
    }

    fn vain(&self) -> MutexGuard<'_, Vain> {
        self.vain.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads and compiles a model, and notes which files it asked for in vain.
    ///
    /// # Errors
    /// All that is wrong with it, each with file, line and column.
    pub fn load(&self, path: &str) -> Result<Loaded, Diagnostics> {
        let loaded = self.files.load(path);
        *self.vain() = match &loaded {
            Ok(_) => Vain::default(),
            Err(error) => Vain { missing: error.missing.clone(), tried: error.tried.clone() },
        };
        // Scripts list the missing files themselves, or fetch them.
        loaded.map_err(|error| error.diagnostics)
    }
}
