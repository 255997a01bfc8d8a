//! Where compiled models are kept.

use std::path::PathBuf;

/// The folder that `ROBOHIVE_CACHE` names, else the user's for files that can be made again.
pub fn folder() -> Option<PathBuf> {
    let named = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let absolute = |name: &str| named(name).filter(|path| path.is_absolute());
    named("ROBOHIVE_CACHE").or_else(|| {
        let home = |below: &str| absolute("HOME").map(|home| home.join(below));
        let folder = if cfg!(windows) {
            absolute("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            home("Library/Caches")
        } else {
            absolute("XDG_CACHE_HOME").or_else(|| home(".cache"))
        };
        folder.map(|folder| folder.join("robohive"))
    })
}
