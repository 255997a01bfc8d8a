//! What is published: every crate that may be, packed and built from its archive; and the oldest compiler promised.

use crate::check::{Missing, Outcome};
use crate::command::{cargo, compiler};
use std::path::{Path, PathBuf};

/// Where the archives are built.
const BUILT: &str = "target/packages";

/// Removes what cargo unpacked and built of earlier archives of our crates: it takes an archive of the same version for the
/// same, although the crate has changed since.
fn forget_archives() -> Result<(), String> {
    if Path::new(BUILT).exists() {
        std::fs::remove_dir_all(BUILT).map_err(|error| format!("{BUILT}: {error}"))?;
    }
    let home = |name: &str, below: &str| std::env::var_os(name).map(|home| Path::new(&home).join(below));
    let Some(home) = home("CARGO_HOME", "").or_else(|| home("HOME", ".cargo")) else { return Ok(()) };
    let folders = |path: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(path)
            .map_or(Vec::new(), |entries| entries.flatten().map(|entry| entry.path()).collect())
    };
    let named = |path: &Path, start: &str| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(start))
    };
    // Registries on the disk have names without a host.
    let local = folders(&home.join("registry/src")).into_iter().filter(|path| named(path, "-"));
    for unpacked in local.flat_map(|path| folders(&path)).filter(|path| named(path, "robohive")) {
        std::fs::remove_dir_all(&unpacked).map_err(|error| format!("{}: {error}", unpacked.display()))?;
    }
    Ok(())
}

/// Packs each crate that is published and builds what the archives hold, each against the others' archives.
pub fn run() -> Outcome {
    forget_archives()?;
    // Profiles and the lock file are the workspace's; a dirty tree is what a change under way has.
    cargo(&["publish", "--workspace", "--dry-run", "--allow-dirty", "--target-dir", BUILT])
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
