//! Models from texts and files, with files of the caller's in memory.

use super::model::CompiledModel;
use mjcf::Loader;
use mjcf::diagnostic::Diagnostics;
use mjcf::files::{Disk, FileError, FileProvider, Memory};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Files in memory, then files on the disk.
pub struct Layered {
    memory: Memory,
    disk: Disk,
}

impl Layered {
    /// These files, then the disk's.
    pub fn new(assets: HashMap<String, Vec<u8>>) -> Self {
        let mut memory = Memory::default();
        assets.into_iter().for_each(|(path, content)| memory.insert(path, content));
        Layered { memory, disk: Disk::everywhere() }
    }

    /// The file in memory that `path` means: of that path, or of that name without folders.
    fn in_memory(&self, path: &str) -> Option<Arc<[u8]>> {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        self.memory.read(path).or_else(|_| self.memory.read(name)).ok()
    }
}

impl FileProvider for Layered {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        self.in_memory(path).map_or_else(|| self.disk.read(path), Ok)
    }

    fn exists(&self, path: &str) -> bool {
        self.in_memory(path).is_some() || self.disk.exists(path)
    }
}

fn finish(loaded: Result<mjcf::Loaded, Diagnostics>) -> PyResult<(CompiledModel, Vec<String>)> {
    let loaded = loaded.map_err(|found| {
        // Programs look for the line by this word.
        let line = found.errors().find_map(|error| error.position.as_ref().map(|at| at.line));
        let line = line.map_or(String::new(), |line| format!("\n(line {line})"));
        PyValueError::new_err(format!("XML Error: {found}{line}"))
    })?;
    let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
    Ok((CompiledModel { model: Arc::new(loaded.model) }, warnings))
}

/// The model of a file, MJCF or compiled by `robohive compile`, and what was ignored or assumed.
#[pyfunction]
pub fn load_path(
    py: Python<'_>,
    path: &str,
    assets: HashMap<String, Vec<u8>>,
) -> PyResult<(CompiledModel, Vec<String>)> {
    finish(py.detach(|| Loader::default().files(Layered::new(assets)).load(path)))
}

/// The model of a text, and what was ignored or assumed.
#[pyfunction]
pub fn load_text(
    py: Python<'_>,
    text: &str,
    assets: HashMap<String, Vec<u8>>,
) -> PyResult<(CompiledModel, Vec<String>)> {
    finish(py.detach(|| Loader::default().files(Layered::new(assets)).load_str(text)))
}

/// Files that are read, noted by the paths that they are asked for by.
struct Noting {
    files: Layered,
    paths: Arc<Mutex<Vec<String>>>,
}

impl FileProvider for Noting {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let content = self.files.read(path)?;
        let mut paths = self.paths.lock().unwrap_or_else(PoisonError::into_inner);
        if !paths.iter().any(|known| known == path) {
            paths.push(path.to_owned());
        }
        Ok(content)
    }

    fn exists(&self, path: &str) -> bool {
        self.files.exists(path)
    }
}

/// Paths of all files that the model of a file is made of, that file first.
#[pyfunction]
pub fn dependencies(py: Python<'_>, path: &str) -> PyResult<Vec<String>> {
    let paths = Arc::default();
    let files = Noting { files: Layered::new(HashMap::new()), paths: Arc::clone(&paths) };
    finish(py.detach(|| Loader::default().files(files).load(path)))?;
    let mut paths = paths.lock().unwrap_or_else(PoisonError::into_inner);
    Ok(std::mem::take(&mut *paths))
}

/// The reference of the format, as text.
#[pyfunction]
pub fn schema() -> String {
    mjcf::reference()
}
