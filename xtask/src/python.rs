//! The Python package: its wheel, built and installed into an environment of its own, and its tests there.

use crate::check::{Missing, Outcome};
use crate::command::{installed, output, succeed, target_folder};
use std::path::Path;
use std::process::Command;

/// The oldest Python that the wheel is for.
const OLDEST: &str =
    "import sys; assert sys.version_info >= (3, 10), 'needs Python 3.10'; import venv, ensurepip";

/// Lints the extension module, builds the wheel, installs it with what its tests need, and runs those.
pub fn run() -> Outcome {
    let lint =
        ["clippy", "--profile", "ci", "-p", "robohive-python", "--all-targets", "--", "-D", "warnings"];
    succeed(Command::new("cargo").args(lint))?;
    if !installed("python3") || output(Command::new("python3").args(["-c", OLDEST])).is_err() {
        return Ok(vec![Missing::new(
            "the Python package (there is no Python 3.10 or later with venv)",
            "apt-get install python3-venv",
        )]);
    }
    let folder = target_folder()?.join("python");
    let python = environment(&folder.join("venv"))?;
    let wheels = folder.join("wheels");
    // Of earlier builds, so that the one installed is this one.
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    }
    let maturin =
        ["-m", "maturin", "build", "--profile", "ci", "--manifest-path", "python/Cargo.toml", "--out"];
    succeed(Command::new(&python).args(maturin).arg(&wheels))?;
    let find =
        ["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps", "--no-index", "--find-links"];
    succeed(Command::new(&python).args(find).arg(&wheels).arg("robohive"))?;
    succeed(Command::new(&python).args(["-m", "pytest", "-q", "python/tests"]))?;
    Ok(Vec::new())
}

/// The interpreter of a virtual environment in `folder`, with what builds and tests the package.
fn environment(folder: &Path) -> Result<std::path::PathBuf, String> {
    let python = folder.join("bin/python");
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(folder))?;
    }
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "-r",
        "python/tests/requirements.txt",
    ];
    succeed(Command::new(&python).args(install))?;
    Ok(python)
}
