//! The files of this repository.

use std::path::{Path, PathBuf};

/// Folders that are not part of the sources: what builds and other tools leave.
const NOT_OURS: [&str; 4] = ["target", "artifacts", "coverage", "__pycache__"];

/// The folder of the repository.
pub fn root() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

/// Paths of all files under `folder` with an extension, relative to the repository, sorted.
pub fn files(folder: &str, extension: &str) -> Vec<String> {
    let mut found = Vec::new();
    collect(&root().join(folder), extension, &mut found);
    found.sort();
    found
}

fn collect(folder: &Path, extension: &str, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && !NOT_OURS.contains(&name.as_str()) {
            collect(&path, extension, found);
        } else if path.extension().is_some_and(|e| e == extension) {
            found.push(path.strip_prefix(root()).unwrap().to_string_lossy().into_owned());
        }
    }
}

/// A Rust file.
pub struct Source {
    /// Path relative to the repository.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl Source {
    /// The syntax tree.
    pub fn syntax(&self) -> syn::File {
        syn::parse_file(&self.text).unwrap_or_else(|e| panic!("{}: {e}", self.path))
    }
}

/// All Rust files under `folder`.
pub fn sources(folder: &str) -> Vec<Source> {
    let read = |path: String| Source { text: std::fs::read_to_string(root().join(&path)).unwrap(), path };
    let sources: Vec<_> = files(folder, "rs").into_iter().map(read).collect();
    assert!(!sources.is_empty(), "no sources in {folder:?}");
    sources
}

/// A package of this repository.
pub struct Crate {
    /// Name of the package.
    pub name: String,
    /// Names under which it depends on others, for whatever it builds but its tests.
    pub dependencies: Vec<String>,
    /// The folder of its modules; none where each of its files is a program, or it is one file.
    pub modules: Option<String>,
}

/// All packages.
pub fn crates() -> Vec<Crate> {
    files("", "toml")
        .into_iter()
        .filter(|path| path.ends_with("Cargo.toml"))
        .map(|path| read(&path))
        .collect()
}

/// Reads a manifest: a table in brackets a line, then a key and a value a line.
fn read(path: &str) -> Crate {
    let text = std::fs::read_to_string(root().join(path)).unwrap();
    let (mut table, mut name, mut dependencies) = ("", String::new(), Vec::new());
    for line in text.lines().map(str::trim).filter(|line| !line.starts_with('#')) {
        if let Some(heading) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            table = heading;
            if let Some((_, dependency)) = heading.split_once("dependencies.") {
                dependencies.push(dependency.to_owned());
            }
        } else if let Some((key, value)) = line.split_once('=') {
            let key = key.trim().trim_end_matches(".workspace");
            match table {
                "package" if key == "name" => name = value.trim().trim_matches('"').to_owned(),
                "dependencies" | "build-dependencies" => dependencies.push(key.to_owned()),
                _ if table.ends_with(".dependencies") && table != "workspace.dependencies" => {
                    dependencies.push(key.to_owned());
                }
                _ => {}
            }
        }
    }
    assert!(!name.is_empty(), "{path} names no package");
    let folder = path.trim_end_matches("Cargo.toml").trim_end_matches('/');
    let has_modules =
        |folder: &String| ["lib.rs", "main.rs"].iter().any(|file| root().join(folder).join(file).is_file());
    let modules = [folder.to_owned(), format!("{folder}/src")].into_iter().find(has_modules);
    Crate { name, dependencies, modules }
}
