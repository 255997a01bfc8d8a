//! The own models.

use robohive::physics::Model;
use std::path::{Path, PathBuf};

/// Every model of `assets/`, with its name.
pub fn assets() -> Vec<(String, Model)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let entries = |folder: PathBuf| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries(root).filter(|folder| folder.is_dir()).flat_map(entries).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == "xml"));
    files.sort();
    assert!(files.len() >= 9, "{files:?}");
    let name = |file: &Path| file.file_stem().unwrap().to_string_lossy().into_owned();
    let load = |file: &Path| robohive::mjcf::load(file).unwrap().model;
    files.iter().map(|file| (name(file), load(file))).collect()
}
