//! Which environment a recording is of.

use crate::error::RecordError;
use dataset::trace::TraceReader;
use env::{Arguments, ArgumentsError, Compat};

/// The attribute that holds the id of the environment.
pub const ID: &str = "env";
/// The attribute that says whose behaviour the environment had.
pub const COMPAT: &str = "compat";
/// The attribute that holds the settings that were changed, in TOML.
pub const SETTINGS: &str = "settings";

/// An environment as the attributes of a recording describe it.
#[derive(Clone, Debug)]
pub struct Description {
    /// Its id.
    pub id: String,
    /// Whose behaviour it had; RoboHive's own files do not say, and have RoboHive's.
    pub compat: Compat,
    /// Settings that were changed.
    pub settings: Arguments,
}

impl Description {
    /// The environment of a recording, or of `id` where that is given: then settings are those of the recording if it
    /// names the same id.
    ///
    /// # Errors
    /// The file names no environment and `id` is none, or an attribute cannot be read.
    pub fn of(trace: &TraceReader, id: Option<&str>) -> Result<Self, RecordError> {
        let attributes = trace.attributes()?;
        let attribute =
            |name: &str| attributes.iter().find(|(key, _)| key == name).map(|(_, text)| &text[..]);
        let path = trace.path().display();
        let wrong = |name: &str, error: String| {
            RecordError::Description(format!("{path}: attribute {name}: {error}"))
        };
        let named = attribute(ID);
        let id = id
            .or(named)
            .ok_or_else(|| RecordError::Description(format!("{path} names no environment: give its id")))?;
        let compat = match attribute(COMPAT) {
            Some(name) => name.parse().map_err(|error| wrong(COMPAT, format!("{error}")))?,
            None => Compat::RoboHive07,
        };
        let settings = match attribute(SETTINGS).filter(|_| named == Some(id)) {
            Some(text) => text.parse().map_err(|error: ArgumentsError| wrong(SETTINGS, error.to_string()))?,
            None => Arguments::default(),
        };
        Ok(Description { id: id.to_owned(), compat, settings })
    }
}
