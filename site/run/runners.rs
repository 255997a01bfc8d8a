//! What runs the blocks of pages.

use std::path::PathBuf;

/// What runs blocks, where it is there.
pub struct Runners {
    /// Folder of the repository.
    pub root: PathBuf,
    /// Folder with the command `robohive`.
    pub command: Option<PathBuf>,
    /// An interpreter with the package installed.
    pub python: Option<PathBuf>,
    /// Folder of the npm package.
    pub package: Option<PathBuf>,
    /// What `programs.rs` compiles: the pages whose blocks of Rust it names.
    pub programs: String,
}
