//! Where files of others are looked for: the store first, then folders that the user names.

use crate::entry_path::fold;
use crate::error::StoreError;
use crate::store::Store;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Environment variable with the folder of the store.
const STORE: &str = "ROBOHIVE_STORE";
/// Environment variable with folders to search after the store, separated as in `PATH`.
const ASSETS: &str = "ROBOHIVE_ASSETS";

/// The folder of the user's store: `ROBOHIVE_STORE` where it is set, else `robohive` in the data folder of the user
/// (`XDG_DATA_HOME` or `~/.local/share`; `~/Library/Application Support` on macOS, `LOCALAPPDATA` on Windows).
///
/// # Errors
/// [`StoreError::NoFolder`]: none of these is known.
pub fn default_folder() -> Result<PathBuf, StoreError> {
    folder_by(|name| std::env::var_os(name))
}

fn folder_by(variable: impl Fn(&str) -> Option<OsString>) -> Result<PathBuf, StoreError> {
    let set = |name: &str| variable(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    // The specification of XDG says to ignore relative folders.
    let absolute = |name: &str| set(name).filter(|folder| folder.is_absolute());
    let data = || {
        let home = || absolute("HOME");
        if cfg!(windows) {
            absolute("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            absolute("XDG_DATA_HOME").or_else(|| Some(home()?.join("Library/Application Support")))
        } else {
            absolute("XDG_DATA_HOME").or_else(|| Some(home()?.join(".local/share")))
        }
    };
    set(STORE).or_else(|| Some(data()?.join("robohive"))).ok_or(StoreError::NoFolder)
}

/// A store and the folders that are searched after it.
#[derive(Debug)]
pub struct Search {
    store: Option<Store>,
    folders: Vec<PathBuf>,
}

impl Search {
    /// Searches `store`, then `folders`; each of these has `envs` and `simhive`, or a folder `robohive` with them.
    pub fn new(store: Option<Store>, folders: Vec<PathBuf>) -> Self {
        Search { store, folders }
    }

    /// Searches the user's store, then the folders of `ROBOHIVE_ASSETS`.
    ///
    /// # Errors
    /// The store cannot be opened.
    pub fn from_environment() -> Result<Self, StoreError> {
        let store = match default_folder() {
            Ok(folder) => Some(Store::open(folder)?),
            Err(StoreError::NoFolder) => None,
            Err(error) => return Err(error),
        };
        let folders = std::env::var_os(ASSETS).unwrap_or_default();
        let folders = std::env::split_paths(&folders).filter(|folder| !folder.as_os_str().is_empty());
        Ok(Search::new(store, folders.collect()))
    }

    /// Whether a file is one that was imported into the store.
    pub fn is_imported(&self, file: &Path) -> bool {
        self.store.as_ref().is_some_and(|store| file.starts_with(store.tree()))
    }

    /// The file with a virtual path, from the first place that has it.
    ///
    /// # Errors
    /// The path is not virtual, no place has the file, or the store lists it and lost it.
    pub fn resolve(&self, path: &str) -> Result<PathBuf, StoreError> {
        let folded = fold(path)
            .map_err(|reason| StoreError::NotVirtual { path: path.to_owned(), reason: reason.to_owned() })?;
        match self.store.as_ref().map(|store| store.resolve(&folded)) {
            None | Some(Err(StoreError::Missing { .. })) => {}
            Some(found) => return found,
        }
        let candidates = self.folders.iter().flat_map(|folder| [folder.clone(), folder.join("robohive")]);
        let found = candidates.map(|folder| folder.join(&folded)).find(|file| file.is_file());
        found.ok_or_else(|| {
            let store = self.store.iter().map(|store| store.folder().to_owned());
            StoreError::Missing {
                path: folded,
                searched: store.chain(self.folders.iter().cloned()).collect(),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(all(unix, not(target_os = "macos")))]
    fn the_folder_follows_the_environment() {
        let folder = |variables: &[(&str, &str)]| {
            folder_by(|name| Some(variables.iter().find(|(key, _)| *key == name)?.1.into()))
        };
        let home = ("HOME", "/home/me");
        let is = |variables: &[(&str, &str)], expected: &str| {
            assert_eq!(folder(variables).unwrap(), Path::new(expected), "{variables:?}");
        };
        is(&[home], "/home/me/.local/share/robohive");
        is(&[home, ("XDG_DATA_HOME", "/data")], "/data/robohive");
        is(&[home, ("XDG_DATA_HOME", "data")], "/home/me/.local/share/robohive");
        is(&[home, ("XDG_DATA_HOME", "/data"), ("ROBOHIVE_STORE", "here")], "here");
        is(&[home, ("ROBOHIVE_STORE", "")], "/home/me/.local/share/robohive");
        assert!(matches!(folder(&[]), Err(StoreError::NoFolder)));
    }
}
