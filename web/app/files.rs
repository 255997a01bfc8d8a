//! Files that a person dropped on the page, or chose.

use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Files by their paths.
#[wasm_bindgen]
#[derive(Clone, Default)]
pub struct Files(pub(crate) viewer::Files);

#[wasm_bindgen]
impl Files {
    /// No files yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, or the files in it where its name is that of a zip archive. Folders in `path` are divided by `/`.
    ///
    /// # Errors
    /// There are too many files or too large ones; the archive is damaged.
    pub fn add(&mut self, path: &str, content: Vec<u8>) -> Result<(), JsError> {
        self.0.add(path, content).map_err(JsError::from)
    }

    /// Number of files.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.0.len()
    }
}
