//! What is trained, and how: a TOML file.

use crate::error::PolicyError;
use crate::learn::{Lessons, Settings};
use env::Arguments;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What is trained, and how.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Id of the environment.
    pub id: String,
    /// Seed of the training: with the version of this crate it decides all of it.
    pub seed: u64,
    /// Iterations.
    pub iterations: u64,
    /// Iterations from one checkpoint to the next.
    pub keep_every: u64,
    /// Whose behaviour environments have.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compat: Option<String>,
    /// What moves the environment; our own pipeline where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solver: Option<String>,
    /// Settings of the environment that differ.
    #[serde(default)]
    pub environment: Arguments,
    /// Who shows how it is done, where it is learnt from demonstrations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teacher: Option<Teaching>,
    /// How it is learnt.
    pub learning: Settings,
}

/// Who shows how it is done, and how often.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Teaching {
    /// A controller's name, or the file of a policy.
    pub by: String,
    /// Which demonstrations are asked for.
    pub lessons: Lessons,
}

impl Config {
    /// Reads a file.
    ///
    /// # Errors
    /// It cannot be read, or is no configuration.
    pub fn read(path: &Path) -> Result<Self, PolicyError> {
        let text = std::fs::read_to_string(path).map_err(|error| PolicyError::run(path, error))?;
        let config: Config = toml::from_str(&text).map_err(|error| PolicyError::run(path, error))?;
        config.learning.check().map_err(|message| PolicyError::run(path, message))?;
        Ok(config)
    }

    /// Writes a file, at once or not at all.
    pub(super) fn write(&self, path: &Path) -> Result<(), PolicyError> {
        let text = toml::to_string(self).map_err(|error| PolicyError::run(path, error))?;
        let unfinished = path.with_extension("unfinished");
        let keep = || std::fs::write(&unfinished, text).and_then(|()| std::fs::rename(&unfinished, path));
        keep().map_err(|error| PolicyError::run(path, error))
    }
}
