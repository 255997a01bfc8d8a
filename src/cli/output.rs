//! Files that commands write: their endings, which say what they hold, and where they may not stand.

use crate::failure::Failure;
use crate::terminal::{listed, note};
use std::path::{Path, PathBuf};

/// A model as text.
pub fn model_file(text: &str) -> Result<PathBuf, String> {
    named(text, &["xml"], "models are written to .xml files")
}

/// A compiled model.
pub fn compiled_file(text: &str) -> Result<PathBuf, String> {
    named(text, &["rhm"], "compiled models are .rhm files")
}

/// A numpy archive.
pub fn archive_file(text: &str) -> Result<PathBuf, String> {
    named(text, &["npz"], "numpy archives are .npz files")
}

/// A recording of episodes.
pub fn recording_file(text: &str) -> Result<PathBuf, String> {
    named(text, &["h5", "hdf5", "npz"], "recordings are .h5 or .hdf5 (HDF5), or .npz files (numpy archives)")
}

/// A recording of episodes in HDF5.
pub fn hdf5_file(text: &str) -> Result<PathBuf, String> {
    named(text, &["h5", "hdf5"], "repaired recordings are .h5 or .hdf5 files")
}

fn named(text: &str, endings: &[&str], otherwise: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ends = |ending: &&str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    if endings.iter().any(ends) { Ok(path) } else { Err(otherwise.to_owned()) }
}

/// Refuses to write where a folder stands, or where the folder of the file is missing.
///
/// # Errors
/// What stands in the way.
pub fn check_place(out: &Path) -> Result<(), Failure> {
    if out.is_dir() {
        return Err(Failure::new(format!("{}: this is a folder: name a file in it", out.display())));
    }
    match out.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        None => Ok(()),
        Some(folder) => {
            Err(Failure::new(format!("{}: there is no folder {}: make it", out.display(), folder.display())))
        }
    }
}

/// Refuses to write over a file that is read.
///
/// # Errors
/// The output is that file, by whatever path.
pub fn keep_input(input: &Path, out: &Path) -> Result<(), Failure> {
    if is_same_file(input, out) {
        return Err(Failure::usage(format!(
            "{}: input and output are one file: name another file for the output",
            out.display()
        )));
    }
    Ok(())
}

/// Refuses to replace a file unasked.
///
/// # Errors
/// The output exists.
pub fn keep_existing(out: &Path, force: bool) -> Result<(), Failure> {
    if out.exists() && !force {
        return Err(Failure::usage(format!("{}: the file exists; --force replaces it", out.display())));
    }
    Ok(())
}

/// Whether two paths lead to one file.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

/// Says which names of a recording were left out, because its layout has no place for them.
pub fn note_unmapped(names: &[String]) {
    if !names.is_empty() {
        note(&format!("not recorded, because the layout has no place for: {}", listed(names, 8)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_say_what_a_file_holds() {
        assert!(model_file("a.XML").is_ok() && model_file("a.rhm").is_err());
        assert!(compiled_file("a.rhm").is_ok() && compiled_file("a.xml").is_err());
        assert!(archive_file("a.npz").is_ok() && archive_file("npz").is_err());
        for (name, fits) in
            [("a.h5", true), ("a.HDF5", true), ("a.npz", true), ("a.txt", false), ("a", false)]
        {
            assert_eq!(recording_file(name).is_ok(), fits, "{name}");
        }
        assert!(hdf5_file("a.npz").is_err());
    }
}
