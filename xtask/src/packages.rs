//! What is published: every crate that may be, packed and built from its archive; and the oldest compiler promised.

use crate::check::{Missing, Outcome};
use crate::command::{cargo, compiler};

/// Packs each crate that is published and builds what the archives hold, each against the others' archives.
pub fn run() -> Outcome {
    // Profiles and the lock file are the workspace's; a dirty tree is what a change under way has.
    cargo(&["publish", "--workspace", "--dry-run", "--allow-dirty"])
}

/// Whether all checks of this run used the compiler that `rust-version` promises to be enough.
pub fn rust_version() -> Outcome {
    let manifest = std::fs::read_to_string("Cargo.toml").map_err(|error| format!("Cargo.toml: {error}"))?;
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
