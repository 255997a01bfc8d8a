//! Whether a store still holds what was imported.

use crate::digest::Digest;
use crate::error::StoreError;
use crate::manifest::Manifest;
use crate::progress::{Progress, Watch};
use crate::tree;
use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What is wrong with a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// Its content is gone.
    Missing,
    /// Its content has changed.
    Changed,
    /// The content is sound, but its path in the tree is gone or shows something else.
    Unshown,
    /// It lies in the tree and was never imported.
    Foreign,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Fault::Missing => "missing",
            Fault::Changed => "changed",
            Fault::Unshown => "not in the tree",
            Fault::Foreign => "not imported",
        })
    }
}

/// A file that is not as it was imported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Damage {
    /// Virtual path.
    pub path: String,
    /// What is wrong.
    pub fault: Fault,
    /// What brought it and brings it again; empty for foreign files.
    pub source: String,
}

/// Reads all contents and compares them with their digests.
///
/// # Errors
/// The tree cannot be listed.
pub(crate) fn run(store: &Path, manifest: &Manifest, watch: Watch<'_>) -> Result<Vec<Damage>, StoreError> {
    let mut checked: BTreeMap<Digest, Option<Fault>> = BTreeMap::new();
    let mut damages = Vec::new();
    let total = manifest.entries.values().map(|entry| entry.size).sum();
    let mut done = 0;
    for (path, entry) in &manifest.entries {
        let object = tree::object(store, entry.digest);
        let fault = *checked.entry(entry.digest).or_insert_with(|| content_fault(&object, entry.digest));
        let unshown = || {
            let target = tree::path(store, path);
            (!tree::is_current(&object, &target, entry)).then_some(Fault::Unshown)
        };
        if let Some(fault) = fault.or_else(unshown) {
            damages.push(Damage { path: path.clone(), fault, source: entry.source.clone() });
        }
        done += entry.size;
        watch(Progress { done, total });
    }
    let mut found = Vec::new();
    list(&tree::path(store, ""), "", &mut found)?;
    let foreign = found.into_iter().filter(|path| !manifest.entries.contains_key(path));
    damages.extend(foreign.map(|path| Damage { path, fault: Fault::Foreign, source: String::new() }));
    Ok(damages)
}

fn content_fault(object: &Path, digest: Digest) -> Option<Fault> {
    match Digest::of_file(object) {
        Ok((found, _)) if found == digest => None,
        Err(error) if error.kind() == io::ErrorKind::NotFound => Some(Fault::Missing),
        _ => Some(Fault::Changed),
    }
}

/// Lists the files below `folder`, whose paths begin with `prefix`.
fn list(folder: &Path, prefix: &str, found: &mut Vec<String>) -> Result<(), StoreError> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries.map_err(StoreError::io(folder))?,
    };
    for entry in entries {
        let entry = entry.map_err(StoreError::io(folder))?;
        let path = format!("{prefix}{}", entry.file_name().to_string_lossy());
        let at: PathBuf = entry.path();
        match entry.file_type().map_err(StoreError::io(&at))?.is_dir() {
            true => list(&at, &format!("{path}/"), found)?,
            false => found.push(path),
        }
    }
    Ok(())
}
