//! Digest of the sources that make a model of a text: cached models of another compiler are of no use.

use std::path::{Path, PathBuf};

fn main() {
    let mut files = Vec::new();
    for folder in ["src", "../src/physics"] {
        println!("cargo::rerun-if-changed={folder}");
        collect(Path::new(folder), &mut files);
    }
    files.sort();
    // FNV-1a: versions need to differ, nobody forges them.
    let mut digest: u64 = 0xcbf2_9ce4_8422_2325;
    for byte in files.iter().flat_map(|file| std::fs::read(file).unwrap_or_default()) {
        digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    println!("cargo::rustc-env=ROBOHIVE_COMPILER={digest:016x}");
}

/// Sources in a folder; a package without its neighbours has those of its own version.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}
