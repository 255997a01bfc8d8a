//! A store: what it holds, and where.

use crate::commit::manifest_path;
use crate::entry_path::fold;
use crate::error::StoreError;
use crate::import::{self, ImportOptions, Imported};
use crate::lock::Lock;
use crate::manifest::{Entry, Manifest};
use crate::progress::Watch;
use crate::tree;
use crate::verify::{self, Damage};
use std::path::{Path, PathBuf};

/// Files of others by virtual path, see the \[crate\].
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    manifest: Manifest,
}

impl Store {
    /// Opens the store in a folder; one that does not exist yet is empty, and nothing is created. Where an import was
    /// killed after its manifest was in place, the tree is completed.
    ///
    /// # Errors
    /// The manifest is damaged or of another version, or the file system refuses.
    pub fn open(folder: impl Into<PathBuf>) -> Result<Self, StoreError> {
        let folder = folder.into();
        let path = manifest_path(&folder);
        let mut manifest = Manifest::read(&path)?;
        if !tree::shows(&folder, &manifest) {
            let _lock = Lock::wait(&folder)?;
            // The import that was awaited may have changed it.
            manifest = Manifest::read(&path)?;
            tree::present(&folder, &manifest)?;
        }
        Ok(Store { folder, manifest })
    }

    /// The folder of the store.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The folder that shows the files by their virtual paths.
    pub fn tree(&self) -> PathBuf {
        tree::path(&self.folder, "")
    }

    /// All files, sorted by virtual path.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = (&str, &Entry)> {
        self.manifest.entries.iter().map(|(path, entry)| (path.as_str(), entry))
    }

    /// The file with a virtual path such as `envs/arms/franka/assets/franka_reach_v0.xml`; `folder/..` in it is folded.
    ///
    /// # Errors
    /// The path is not virtual, the store has no such file, or its file is gone.
    pub fn resolve(&self, path: &str) -> Result<PathBuf, StoreError> {
        let folded = fold(path)
            .map_err(|reason| StoreError::NotVirtual { path: path.to_owned(), reason: reason.to_owned() })?;
        if !self.manifest.entries.contains_key(&folded) {
            return Err(StoreError::Missing { path: folded, searched: vec![self.folder.clone()] });
        }
        let file = tree::path(&self.folder, &folded);
        if file.is_file() { Ok(file) } else { Err(StoreError::Gone { path: file }) }
    }

    /// Imports a folder or an archive: tar, tar.xz, tar.gz, zip or wheel.
    ///
    /// # Errors
    /// The source is unreadable, hostile, unknown, or contradicts itself or stored files; another import runs; or the file
    /// system refuses. The store then holds what it held before, unless the file system failed after the manifest was in
    /// place: then [`Store::open`] completes the import.
    pub fn import(
        &mut self,
        source: &Path,
        options: &ImportOptions,
        watch: Watch<'_>,
    ) -> Result<Imported, StoreError> {
        let (manifest, imported) = import::run(&self.folder, source, options, watch)?;
        self.manifest = manifest;
        Ok(imported)
    }

    /// Reads all contents again and returns what is not as it was imported.
    ///
    /// # Errors
    /// The tree cannot be listed.
    pub fn verify(&self, watch: Watch<'_>) -> Result<Vec<Damage>, StoreError> {
        verify::run(&self.folder, &self.manifest, watch)
    }
}
