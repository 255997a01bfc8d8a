//! The commit that the command is built from, read from git's files so that no git is needed. A source tree without
//! them builds a command that names its version alone. With the feature `page`, the files of the page.

use std::fs::read_to_string;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let commit = published_commit().or_else(checked_out_commit);
    let text = commit.map_or("follows".to_owned(), |commit| format!("commit {}, follows", &commit[..10]));
    println!("cargo::rustc-env=ROBOHIVE_FOLLOWS={text}");
    if std::env::var_os("CARGO_FEATURE_PAGE").is_some() {
        embed_page();
    }
}

/// Writes a table of the page's files, which the command includes.
fn embed_page() {
    println!("cargo::rerun-if-env-changed=ROBOHIVE_PAGE");
    let named = std::env::var_os("ROBOHIVE_PAGE").map_or("../../target/web".into(), PathBuf::from);
    let folder = named.canonicalize().unwrap_or(named);
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries =
        std::fs::read_dir(&folder).map(|entries| entries.flatten().map(|entry| entry.path()).collect());
    let mut files: Vec<PathBuf> = entries.unwrap_or_default();
    files.retain(|path| path.is_file() && !path.ends_with("inline.js"));
    files.sort();
    if !files.iter().any(|path| path.ends_with("index.html")) {
        println!(
            "cargo::error=the feature `page` needs the page, and {} does not hold it: run `cargo xtask web` first, or \
             name its folder in ROBOHIVE_PAGE",
            folder.display()
        );
        return;
    }
    let row = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        format!("({name:?}, include_bytes!({path:?}).as_slice()),\n")
    };
    let rows: String = files.iter().map(row).collect();
    let table = format!("pub const FILES: &[(&str, &[u8])] = &[\n{rows}];\n");
    let place = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join("page.rs");
    if let Err(error) = std::fs::write(&place, table) {
        println!("cargo::error={}: {error}", place.display());
    }
}

/// The commit that `cargo package` notes in a published crate.
fn published_commit() -> Option<String> {
    let note = watched(Path::new(".cargo_vcs_info.json"))?;
    let rest = note.split_once("\"sha1\"")?.1.split_once('"')?.1;
    hash(rest.split_once('"')?.0)
}

/// The commit that is checked out in the repository of this crate, not in one that carries a copy of it.
fn checked_out_commit() -> Option<String> {
    let root = Path::new("../..");
    let own = root.join("src/cli").canonicalize().ok()? == Path::new(".").canonicalize().ok()?;
    let git = root.join(".git");
    // In a linked worktree the entry is a file that names the folder.
    let folder = match read_to_string(&git) {
        Ok(text) => root.join(text.strip_prefix("gitdir:")?.trim()),
        Err(_) => git,
    };
    let head = watched(&folder.join("HEAD")).filter(|_| own)?;
    // Grows by a line with every commit.
    _ = watched(&folder.join("logs/HEAD"));
    let Some(name) = head.trim().strip_prefix("ref: ") else { return hash(head.trim()) };
    let shared =
        read_to_string(folder.join("commondir")).map_or(folder.clone(), |text| folder.join(text.trim()));
    let loose = [&folder, &shared].into_iter().find_map(|folder: &PathBuf| watched(&folder.join(name)));
    let packed = || {
        let refs = watched(&shared.join("packed-refs"))?;
        let mut lines = refs.lines().filter_map(|line| line.split_once(' '));
        lines.find(|(_, packed)| *packed == name).map(|(commit, _)| commit.to_owned())
    };
    hash(loose.or_else(packed)?.trim())
}

/// The text of a file, if it exists; cargo runs this script again when it changes.
fn watched(path: &Path) -> Option<String> {
    let text = read_to_string(path).ok()?;
    println!("cargo::rerun-if-changed={}", path.display());
    Some(text)
}

/// A text that is the name of a commit.
fn hash(text: &str) -> Option<String> {
    let good = text.len() >= 40 && text.bytes().all(|b| b.is_ascii_hexdigit());
    good.then(|| text.to_owned())
}
