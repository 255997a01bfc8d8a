//! An import becomes visible: objects first, then the manifest that names them, then the tree.

use crate::digest::Digest;
use crate::error::StoreError;
use crate::manifest::Manifest;
use crate::tree;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Name of the manifest in a store.
const MANIFEST: &str = "manifest";
/// Name of the folder in which an import works.
const STAGING: &str = "staging";

/// The manifest of a store.
pub(crate) fn manifest_path(store: &Path) -> PathBuf {
    store.join(MANIFEST)
}

/// The folder in which an import works; removed in the end.
pub(crate) struct Staging(PathBuf);

impl Staging {
    /// An empty folder; what a killed import left is removed.
    ///
    /// # Errors
    /// The file system refuses.
    pub(crate) fn clear(store: &Path) -> Result<Self, StoreError> {
        let folder = store.join(STAGING);
        match fs::remove_dir_all(&folder) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(StoreError::io(folder)(error));
            }
            _ => {}
        }
        fs::create_dir(&folder).map_err(StoreError::io(&folder))?;
        Ok(Staging(folder))
    }

    /// The folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.0
    }
}

impl Drop for Staging {
    /// What cannot be removed now is removed by the next import.
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.0);
    }
}

/// Makes `manifest` the one of the store. `arrived` are the digests of the contents that lie in the staging folder.
///
/// # Errors
/// The file system refuses.
pub(crate) fn commit(
    store: &Path,
    staging: &Staging,
    arrived: &BTreeSet<Digest>,
    manifest: &Manifest,
) -> Result<(), StoreError> {
    for digest in arrived {
        let object = tree::object(store, *digest);
        // A damaged object is replaced, so that importing again repairs a store.
        if !Digest::of_file(&object).is_ok_and(|(found, _)| found == *digest) {
            settle(&staging.folder().join(digest.to_string()), &object)?;
        }
    }
    let unfinished = staging.folder().join(MANIFEST);
    fs::write(&unfinished, manifest.text()).map_err(StoreError::io(&unfinished))?;
    let path = manifest_path(store);
    fs::rename(&unfinished, &path).map_err(StoreError::io(path))?;
    tree::present(store, manifest)?;
    sweep(store, manifest)
}

/// Moves a staged content to its place. Objects are read-only, since links in the tree are the same file.
fn settle(staged: &Path, object: &Path) -> Result<(), StoreError> {
    let folder = object.parent().unwrap_or(object);
    fs::create_dir_all(folder).map_err(StoreError::io(folder))?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let read_only = fs::Permissions::from_mode(0o444);
        fs::set_permissions(staged, read_only).map_err(StoreError::io(staged))?;
    }
    fs::rename(staged, object).map_err(StoreError::io(object))
}

/// Removes objects that the manifest does not name: what was replaced, and what killed imports left.
fn sweep(store: &Path, manifest: &Manifest) -> Result<(), StoreError> {
    let named: BTreeSet<_> =
        manifest.entries.values().map(|entry| tree::object(store, entry.digest)).collect();
    for object in tree::objects(store)?.into_iter().filter(|object| !named.contains(object)) {
        fs::remove_file(&object).map_err(StoreError::io(object))?;
    }
    Ok(())
}
