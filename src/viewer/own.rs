//! Models of our own, which programs carry.

use mjcf::diagnostic::Diagnostics;
use mjcf::{Loaded, Loader};
use std::fmt;

/// Why a model of our own is not there.
#[derive(Clone, Debug)]
pub enum OwnModelError {
    /// None has this name.
    Unknown(String),
    /// It cannot be compiled.
    Unreadable(Diagnostics),
}

impl fmt::Display for OwnModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OwnModelError::Unknown(name) => {
                let names: Vec<&str> = own_models().map(|(name, _)| name).collect();
                write!(f, "{name} is no model of our own: {}", names.join(", "))
            }
            OwnModelError::Unreadable(diagnostics) => write!(f, "{diagnostics}"),
        }
    }
}

impl std::error::Error for OwnModelError {}

/// Names and paths in `assets/` of the models that stand for themselves.
pub fn own_models() -> impl Iterator<Item = (&'static str, &'static str)> {
    assets::models()
}

/// What reads them by their paths.
pub fn own_loader() -> Loader {
    Loader::default().files(assets::Own)
}

/// The model of a name.
///
/// # Errors
/// There is none of that name, or it cannot be compiled.
pub fn load_own(name: &str) -> Result<Loaded, OwnModelError> {
    let found = own_models().find(|(own, _)| *own == name);
    let (_, path) = found.ok_or_else(|| OwnModelError::Unknown(name.to_owned()))?;
    own_loader().load(path).map_err(OwnModelError::Unreadable)
}
