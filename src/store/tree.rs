//! The virtual paths of a store as real ones, for programs that read models with relative includes.
//!
//! The tree follows the manifest: what shows another content is replaced, what is missing is added, by renaming, so that a
//! file is at no time half there. A stamp beside the tree says which manifest it shows.

use crate::digest::Digest;
use crate::error::StoreError;
use crate::manifest::{Entry, Manifest};
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// Name of the folder of contents in a store.
const OBJECTS: &str = "objects";
/// Name of the tree in a store.
const TREE: &str = "tree";
/// Name of the file that says which manifest the tree shows.
const STAMP: &str = "tree.stamp";
/// Name of a file on its way into the tree.
const UNFINISHED: &str = "tree.part";

/// The real path of a virtual one.
pub(crate) fn path(store: &Path, virtual_path: &str) -> PathBuf {
    store.join(TREE).join(virtual_path)
}

/// All files that hold contents.
///
/// # Errors
/// The folder cannot be listed.
pub(crate) fn objects(store: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let folder = store.join(OBJECTS);
    let entries = fs::read_dir(&folder).map_err(StoreError::io(&folder))?;
    let paths: io::Result<_> = entries.map(|entry| entry.map(|entry| entry.path())).collect();
    paths.map_err(StoreError::io(folder))
}

/// The file that holds the content with this digest.
pub(crate) fn object(store: &Path, digest: Digest) -> PathBuf {
    store.join(OBJECTS).join(digest.to_string())
}

/// Whether the tree shows this manifest.
pub(crate) fn shows(store: &Path, manifest: &Manifest) -> bool {
    match fs::read_to_string(store.join(STAMP)) {
        Ok(stamp) => stamp == manifest.digest().to_string(),
        Err(_) => manifest.entries.is_empty(),
    }
}

/// Makes the tree show a manifest, but for files whose object is missing.
///
/// # Errors
/// The file system refuses.
pub(crate) fn present(store: &Path, manifest: &Manifest) -> Result<(), StoreError> {
    for (virtual_path, entry) in &manifest.entries {
        let (object, target) = (object(store, entry.digest), path(store, virtual_path));
        if object.exists() && !is_current(&object, &target, entry) {
            place(store, &object, &target)?;
        }
    }
    let (unfinished, stamp) = (store.join(UNFINISHED), store.join(STAMP));
    fs::write(&unfinished, manifest.digest().to_string()).map_err(StoreError::io(&unfinished))?;
    fs::rename(&unfinished, &stamp).map_err(StoreError::io(stamp))
}

/// Whether the file in the tree has the content of its object, without reading it where both are one file.
pub(crate) fn is_current(object: &Path, target: &Path, entry: &Entry) -> bool {
    let Ok(shown) = fs::symlink_metadata(target) else { return false };
    if !shown.is_file() || shown.len() != entry.size {
        return false;
    }
    let linked = fs::metadata(object).is_ok_and(|stored| is_one_file(&stored, &shown));
    linked || Digest::of_file(target).is_ok_and(|(digest, _)| digest == entry.digest)
}

#[cfg(unix)]
fn is_one_file(a: &Metadata, b: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn is_one_file(_: &Metadata, _: &Metadata) -> bool {
    false
}

/// Puts an object into the tree: a link, or a copy where the file system has none or no more of them.
fn place(store: &Path, object: &Path, target: &Path) -> Result<(), StoreError> {
    let unfinished = store.join(UNFINISHED);
    match fs::remove_file(&unfinished) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            return Err(StoreError::io(unfinished)(error));
        }
        _ => {}
    }
    let folder = target.parent().unwrap_or(store);
    fs::create_dir_all(folder).map_err(StoreError::io(folder))?;
    let linked = fs::hard_link(object, &unfinished);
    linked.or_else(|_| fs::copy(object, &unfinished).map(drop)).map_err(StoreError::io(object))?;
    fs::rename(&unfinished, target).map_err(StoreError::io(target))
}
