//! What is published: every crate that may be, packed and compiled from its archive; and the oldest compiler promised.

use crate::built::PROFILE;
use crate::command::{cargo, compiler, output, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What archives are made of.
pub const INPUTS: &[&str] =
    &["src", "mjcf", "assets", "examples", "README.md", "CHANGELOG.md", "THIRD_PARTY.md"];

/// Packs each crate that is published, unpacks the archives into a workspace in which they stand for each other, and checks
/// that all compile there: an archive that lacks a file does not.
pub fn run() -> Outcome {
    let folder = target_folder()?.join("packages");
    remove(&folder)?;
    // A dirty tree is what a change under way has.
    let pack = ["package", "--quiet", "--workspace", "--no-verify", "--allow-dirty", "--target-dir"];
    // They are not published, and neither is what they depend on, which cargo then looks for in vain.
    let exclude = ["--exclude", "robohive-web-app", "--exclude", "robohive-python"];
    succeed(Command::new("cargo").args(pack).arg(&folder).args(exclude))?;
    let crates = unpack(&folder.join("package"))?;
    println!("{} archives: {}", crates.len(), crates.join(", "));
    let workspace = folder.join("package");
    let manifest = read(Path::new("Cargo.toml"))?;
    write(&workspace.join("Cargo.toml"), &workspace_of(&crates, &manifest)?)?;
    for file in ["Cargo.lock", "rust-toolchain.toml"] {
        write(&workspace.join(file), &read(Path::new(file))?)?;
    }
    // Compiled beside everything else, so that dependencies are shared.
    let mut check = Command::new("cargo");
    check.args(["check", "--workspace", "--profile", PROFILE, "--target-dir"]).arg(target_folder()?);
    succeed(check.current_dir(&workspace)).map(|()| Vec::new())
}

/// Unpacks every archive in `folder`; the folders of those that are published.
fn unpack(folder: &Path) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let archives = entries.flatten().map(|entry| entry.path());
    let archives: Vec<PathBuf> =
        archives.filter(|path| path.extension().is_some_and(|end| end == "crate")).collect();
    let mut crates = Vec::new();
    for archive in &archives {
        // Archives have one date for all files, by which changed ones would not be compiled again.
        output(Command::new("tar").arg("-xzmf").arg(archive).arg("-C").arg(folder))?;
        let name = archive.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // Cargo has rewritten it, so that it names no path.
        let manifest = read(&folder.join(&name).join("Cargo.toml"))?;
        if manifest.contains("\npublish = false") {
            continue;
        }
        if manifest.contains("\npath = \"..") {
            return Err(format!("the archive of {name} depends on a folder"));
        }
        crates.push(name);
    }
    crates.sort();
    match crates.is_empty() {
        true => Err("cargo has packed nothing".into()),
        false => Ok(crates),
    }
}

/// The manifest of a workspace of `crates`, folders named after crate and version, with the profiles of `manifest`.
fn workspace_of(crates: &[String], manifest: &str) -> Result<String, String> {
    let mut text = format!("[workspace]\nresolver = \"3\"\nmembers = {crates:?}\n\n[patch.crates-io]\n");
    for folder in crates {
        let (name, _) = folder.rsplit_once('-').ok_or_else(|| format!("{folder} names no version"))?;
        let _ = writeln!(text, "{name} = {{ path = {folder:?} }}");
    }
    let profiles = manifest.find("\n[profile.").ok_or("Cargo.toml has no profiles")?;
    Ok(text + &manifest[profiles..])
}

/// Lets cargo itself go through the motions of publishing all crates, each built from its archive.
pub fn publish() -> Outcome {
    let folder = target_folder()?.join("publish");
    remove(&folder)?;
    let folder = folder.to_string_lossy().into_owned();
    cargo(&["publish", "--workspace", "--dry-run", "--allow-dirty", "--target-dir", &folder])
}

/// Whether all checks of this run used the compiler that `rust-version` promises to be enough.
pub fn rust_version() -> Outcome {
    let manifest = read(Path::new("Cargo.toml"))?;
    let promised = manifest.lines().find_map(|line| line.strip_prefix("rust-version = ")).unwrap_or_default();
    let promised = promised.trim_matches('"');
    let used = compiler()?;
    println!("{used}; rust-version = {promised:?}");
    if used.strip_prefix("rustc ").is_some_and(|version| version.starts_with(&format!("{promised}."))) {
        return Ok(Vec::new());
    }
    let what = format!("the minimum Rust version, {promised} (this is {used})");
    Ok(vec![Missing::new(what, format!("rustup toolchain install {promised}.0"))])
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

fn remove(folder: &Path) -> Result<(), String> {
    match folder.exists() {
        true => std::fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display())),
        false => Ok(()),
    }
}
