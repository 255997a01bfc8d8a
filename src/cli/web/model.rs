//! Which files a model reads.

use mjcf::Loader;
use mjcf::files::{Disk, FileError, FileProvider};
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The files on the disk that the model at `path` reads, whether it compiles or not; itself at least.
pub fn files(path: &Path) -> Vec<PathBuf> {
    let noted = Noting { disk: Arc::new(Disk::everywhere()), read: Arc::default() };
    // What is wrong with the model, the page says.
    let _ = Loader::default().files(noted.clone()).load(path);
    let read = noted.read.lock().unwrap_or_else(PoisonError::into_inner);
    let own = path.to_string_lossy().into_owned();
    let all: BTreeSet<PathBuf> =
        read.iter().chain([&own]).filter_map(|path| absolute(Path::new(path))).collect();
    all.into_iter().collect()
}

/// The path from the root, without `.` and `..`.
pub fn absolute(path: &Path) -> Option<PathBuf> {
    let mut whole = PathBuf::new();
    for part in std::path::absolute(path).ok()?.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => _ = whole.pop(),
            other => whole.push(other),
        }
    }
    Some(whole)
}

/// The folder that all of these files are in.
pub fn common_folder(files: &[PathBuf]) -> PathBuf {
    let first = files.first().and_then(|file| file.parent()).unwrap_or(Path::new("/"));
    let shared = first.ancestors().find(|folder| files.iter().all(|file| file.starts_with(folder)));
    shared.unwrap_or(Path::new("/")).to_owned()
}

/// Files of the disk, and which of them were read.
#[derive(Clone)]
struct Noting {
    disk: Arc<Disk>,
    read: Arc<Mutex<BTreeSet<String>>>,
}

impl FileProvider for Noting {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        let read = self.disk.read(path)?;
        self.read.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_owned());
        Ok(read)
    }

    fn exists(&self, path: &str) -> bool {
        self.disk.exists(path)
    }
}
