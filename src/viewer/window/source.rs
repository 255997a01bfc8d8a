//! Where models come from.

use mjcf::diagnostic::Diagnostics;
use mjcf::files::Memory;
use mjcf::{Loaded, Loader};
use physics::Model;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A model that can be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A file: MJCF, URDF, or what `robohive compile` wrote.
    File(PathBuf),
    /// A model of our own, by its path in `assets/`.
    Own(&'static str),
}

impl Source {
    /// Models of our own.
    pub fn own() -> impl Iterator<Item = Source> {
        assets::FILES
            .iter()
            .map(|(path, _)| *path)
            .filter(|path| path.ends_with(".xml") && !is_part(path))
            .map(Source::Own)
    }

    /// What people call it.
    pub fn title(&self) -> String {
        match self {
            Source::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Source::Own(path) => {
                Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned()
            }
        }
    }

    /// Reads and compiles it.
    ///
    /// # Errors
    /// What is wrong with it, with file, line and column.
    pub(super) fn load(&self) -> Result<Loaded, String> {
        match self {
            Source::File(path) => load_file(path),
            Source::Own(path) => {
                let mut files = Memory::default();
                assets::FILES.iter().for_each(|(path, text)| files.insert(path, text.as_bytes()));
                Loader::default().files(files).load(path).map_err(|errors| errors.to_string())
            }
        }
    }

    /// When its file was changed last.
    pub fn changed(&self) -> Option<SystemTime> {
        match self {
            Source::File(path) => std::fs::metadata(path).and_then(|about| about.modified()).ok(),
            Source::Own(_) => None,
        }
    }
}

/// Whether a file is a part of models rather than one.
fn is_part(path: &str) -> bool {
    path.contains("/parts/")
}

fn load_file(path: &Path) -> Result<Loaded, String> {
    let mut start = [0; 64];
    let is_compiled = std::fs::File::open(path)
        .and_then(|mut file| std::io::Read::read(&mut file, &mut start))
        .is_ok_and(|_| physics::binary::is_model(&start));
    if is_compiled {
        let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let model = Model::from_bytes(&bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        return Ok(Loaded { model, warnings: Diagnostics::default() });
    }
    mjcf::load(path).map_err(|errors| errors.to_string())
}
