//! Lists the models and configs of all folders, so that a file that is added belongs to the crate.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    println!("cargo::rerun-if-changed={}", root.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(&root)? {
        let path = entry?.path();
        if path.is_dir() {
            texts(&path, &mut files)?;
        }
    }
    let mut rows: Vec<_> =
        files.iter().filter_map(|file| Some((name(file.strip_prefix(&root).ok()?)?, file))).collect();
    rows.sort();
    let rows = rows.iter().map(|(name, file)| format!("    ({name:?}, include_str!({file:?})),\n"));
    fs::write(out.join("texts.rs"), format!("&[\n{}]\n", rows.collect::<String>()))
}

/// A path as models write it.
fn name(path: &Path) -> Option<String> {
    Some(path.to_str()?.replace('\\', "/"))
}

/// Appends the models and configs below a folder.
fn texts(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            texts(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "xml" || extension == "toml") {
            files.push(path);
        }
    }
    Ok(())
}
