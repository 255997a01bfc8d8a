//! Folders: every file below, in the order of names. Links are followed inside of the folder only.

use crate::error::StoreError;
use crate::intake::Intake;
use crate::layout;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A file that was found, and its path in the source.
struct Found {
    at: PathBuf,
    path: String,
}

/// Takes every file below `root`.
///
/// # Errors
/// A folder or file cannot be read, or asks for more than the limits allow.
pub(crate) fn read(root: &Path, intake: &mut Intake<'_>) -> Result<(), StoreError> {
    let root = fs::canonicalize(root).map_err(StoreError::io(root))?;
    let mut found = Vec::new();
    walk(&root, &root, "", &mut vec![root.clone()], intake, &mut found)?;
    for Found { at, path } in found {
        let file = File::open(&at).map_err(StoreError::io(&at))?;
        let mut content = intake.bounded(file, None);
        let before = content.unpacked.get();
        intake.file(path, &mut content)?;
        let read = content.unpacked.get() - before;
        intake.position.set(intake.position.get() + read);
    }
    Ok(())
}

/// Lists the files below `folder`, whose paths begin with `prefix`; `open` are the folders that lead to it.
fn walk(
    root: &Path,
    folder: &Path,
    prefix: &str,
    open: &mut Vec<PathBuf>,
    intake: &mut Intake<'_>,
    found: &mut Vec<Found>,
) -> Result<(), StoreError> {
    let unreadable = || StoreError::io(folder);
    let listed: Result<Vec<_>, _> = fs::read_dir(folder).map_err(unreadable())?.collect();
    let mut listed = listed.map_err(unreadable())?;
    listed.sort_by_key(fs::DirEntry::file_name);
    for entry in listed {
        let at = entry.path();
        let Some(name) = entry.file_name().to_str().map(str::to_owned) else {
            intake.skipped.count("with a name that is not UTF-8");
            continue;
        };
        let path = intake.entry(format!("{prefix}{name}").as_bytes())?;
        let kind = entry.file_type().map_err(StoreError::io(&at))?;
        let real = if kind.is_symlink() {
            match fs::canonicalize(&at) {
                Ok(real) if real.starts_with(root) && !open.contains(&real) => real,
                _ => {
                    intake.skipped.links.push(path);
                    continue;
                }
            }
        } else {
            at
        };
        let metadata = fs::metadata(&real).map_err(StoreError::io(&real))?;
        if metadata.is_dir() && layout::is_foreign(&path) {
            intake.skipped.count(format!("in {name}/ (the folder is not entered)"));
        } else if metadata.is_dir() {
            open.push(real.clone());
            walk(root, &real, &format!("{path}/"), open, intake, found)?;
            open.pop();
        } else if metadata.is_file() {
            intake.total += if layout::is_kept(&path) { metadata.len() } else { 0 };
            found.push(Found { at: real, path });
        } else {
            intake.skipped.count("that are pipes, sockets or devices");
        }
    }
    Ok(())
}
