//! The command as a user runs it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The top of the repository.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The command in the repository, without arguments.
pub fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_robohive"));
    command.current_dir(ROOT);
    for variable in ["ROBOHIVE_CACHE", "NO_COLOR", "CLICOLOR_FORCE", "COLUMNS", "ROBOHIVE_ASSETS"] {
        command.env_remove(variable);
    }
    // Never the store of whoever runs the tests.
    command.env("ROBOHIVE_STORE", scratch("store"));
    command
}

/// Runs the command to its end.
pub fn robohive(arguments: &[&str]) -> Output {
    command().args(arguments).output().unwrap()
}

/// Output as text.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A path for one test's output.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}
