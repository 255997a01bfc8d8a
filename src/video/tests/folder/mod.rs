//! A folder for the files of a test.

use std::path::PathBuf;

/// A folder that is removed with its files.
pub struct Folder(PathBuf);

impl Folder {
    /// An empty folder of a name that no other test uses.
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("robohive-video-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    /// The path of a file in it.
    pub fn join(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
