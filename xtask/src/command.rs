//! Running other programs.

use crate::outcome::Outcome;
use std::path::PathBuf;
use std::process::Command;

/// Runs cargo, with its output on the terminal; nothing is left unchecked when it succeeds.
pub fn cargo(arguments: &[&str]) -> Outcome {
    succeed(Command::new("cargo").args(arguments)).map(|()| Vec::new())
}

/// Runs a program with its output on the terminal; an error unless it succeeds.
pub fn succeed(command: &mut Command) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?}: {status}")),
        Err(error) => Err(format!("{command:?}: {error}")),
    }
}

/// Standard output and standard error of a program; an error unless it succeeds.
pub fn output(command: &mut Command) -> Result<(String, String), String> {
    let out = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    let [stdout, stderr] = [out.stdout, out.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if out.status.success() {
        Ok((stdout, stderr))
    } else {
        Err(format!("{command:?}: {}\n{stderr}", out.status))
    }
}

/// Whether a program of this name can be started. Not all of them know `--version`.
pub fn installed(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// What tells cargo to run the programs of tests of the package in a folder, among those of all packages that are selected.
pub fn tests_of(folder: &str) -> Result<Vec<String>, String> {
    let tests = PathBuf::from(folder).join("tests");
    let entries = std::fs::read_dir(&tests).map_err(|error| format!("{}: {error}", tests.display()))?;
    let programs = entries.flatten().map(|entry| entry.path());
    let programs = programs.filter(|path| {
        path.join("main.rs").is_file() || path.extension().is_some_and(|extension| extension == "rs")
    });
    let names = programs.filter_map(|path| path.file_stem().map(|name| name.to_string_lossy().into_owned()));
    Ok(names.flat_map(|name| ["--test".to_owned(), name]).collect())
}

/// Where cargo puts what it builds.
pub fn target_folder() -> Result<PathBuf, String> {
    let (text, _) =
        output(Command::new("cargo").args(["metadata", "--no-deps", "--offline", "--format-version", "1"]))?;
    let folder = text.split_once("\"target_directory\":\"").and_then(|(_, rest)| rest.split_once('"'));
    folder.map(|(folder, _)| folder.into()).ok_or_else(|| "cargo names no target directory".into())
}

/// The version of the compiler that cargo calls in this folder, as in `rustc 1.95.0`.
pub fn compiler() -> Result<String, String> {
    let (version, _) = output(Command::new("rustc").arg("--version"))?;
    Ok(version.split(" (").next().unwrap_or_default().trim().to_owned())
}
