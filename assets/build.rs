//! Lists the models and configs of all folders, and the trained policies, so that a file that is added belongs to the crate.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    println!("cargo::rerun-if-changed={}", root.display());
    // The manifest of the crate is in no folder.
    let texts = files(&root, &["xml", "toml"])?.into_iter().filter(|(name, _)| name.contains('/'));
    let texts = texts.map(|(name, file)| format!("    ({name:?}, include_str!({file:?})),\n"));
    fs::write(out.join("texts.rs"), format!("&[\n{}]\n", texts.collect::<String>()))?;
    let policies = files(&root.join("policies"), &["safetensors"])?;
    let ids = policies.iter().map(|(name, _)| format!("    {:?},\n", name.trim_end_matches(".safetensors")));
    fs::write(out.join("policy_ids.rs"), format!("&[\n{}]\n", ids.collect::<String>()))?;
    let contents = policies.iter().map(|(_, file)| format!("    include_bytes!({file:?}),\n"));
    fs::write(out.join("policies.rs"), format!("&[\n{}]\n", contents.collect::<String>()))
}

/// The files below a folder that have one of these extensions, by their paths there as models write them, sorted.
fn files(folder: &Path, extensions: &[&str]) -> io::Result<Vec<(String, PathBuf)>> {
    let mut found = Vec::new();
    find(folder, extensions, &mut found)?;
    let name = |file: &Path| Some(file.strip_prefix(folder).ok()?.to_str()?.replace('\\', "/"));
    let mut named: Vec<_> = found.into_iter().filter_map(|file| Some((name(&file)?, file))).collect();
    named.sort();
    Ok(named)
}

/// Appends the files below a folder that have one of these extensions.
fn find(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            find(&path, extensions, found)?;
        } else if path.extension().is_some_and(|own| extensions.iter().any(|extension| own == *extension)) {
            found.push(path);
        }
    }
    Ok(())
}
