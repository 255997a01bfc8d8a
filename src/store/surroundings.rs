//! What is stated around an imported folder: the licence of the checkout or the installed package that it is a part of.

use crate::layout::is_licence;
use crate::licence::{Licence, MAX_TEXT};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Most folders upwards that are looked at.
const DEPTH: usize = 4;

/// Files and folders that only the top of a checkout has.
const TOP: [&str; 3] = [".git", "setup.py", "pyproject.toml"];

/// The licence texts of the checkout or installed package around `folder`.
pub(crate) fn licences(folder: &Path) -> Vec<Licence> {
    let mut inner = folder;
    for outer in folder.ancestors().skip(1).take(DEPTH) {
        let name = inner.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let metadata = list(outer).into_iter().filter(|path| is_metadata(path, name));
        let mut folders: Vec<_> = metadata.flat_map(|path| [path.join("licenses"), path]).collect();
        if TOP.iter().any(|top| outer.join(top).exists()) {
            folders.push(outer.to_owned());
        }
        if !folders.is_empty() {
            return folders.iter().flat_map(|folder| list(folder)).filter_map(|path| read(&path)).collect();
        }
        inner = outer;
    }
    Vec::new()
}

/// Whether the folder holds the metadata of the installed package `name`.
fn is_metadata(path: &Path, name: &str) -> bool {
    let folder = path.file_name().and_then(|folder| folder.to_str()).unwrap_or_default();
    let version = folder.strip_suffix(".dist-info").and_then(|rest| rest.strip_prefix(name));
    version.is_some_and(|version| version.starts_with('-'))
}

/// What is in a folder, sorted; nothing where it cannot be read, since only a licence would be learnt.
fn list(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// The licence that a file states, where it is a licence text.
fn read(path: &Path) -> Option<Licence> {
    let name = path.file_name().and_then(|name| name.to_str()).filter(|name| is_licence(name));
    name.filter(|_| path.is_file())?;
    let mut text = Vec::new();
    File::open(path).and_then(|file| file.take(MAX_TEXT).read_to_end(&mut text)).ok()?;
    Some(Licence::of_text(&String::from_utf8_lossy(&text)))
}
