//! What is trained, and how: a TOML file.

use crate::error::PolicyError;
use crate::learn::{Settings, Teaching};
use env::Arguments;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use toml::{Table, Value};

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

impl Config {
    /// A training in the environments of an id as they are, of 100 iterations.
    pub fn new(id: impl Into<String>, learning: Settings) -> Self {
        Config {
            id: id.into(),
            seed: 1,
            iterations: 100,
            keep_every: 10,
            compat: None,
            solver: None,
            environment: Arguments::default(),
            teacher: None,
            learning,
        }
    }

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

    /// Who teaches; nobody where nothing is learnt from demonstrations.
    ///
    /// # Errors
    /// There is no teacher where one is needed, or one where none is.
    pub fn teaching(&self) -> Result<Option<&Teaching>, PolicyError> {
        let refuse = |message: &str| PolicyError::Setting { key: "teacher".into(), message: message.into() };
        match (&self.teacher, self.learning.algorithm.needs_demonstrations()) {
            (None, true) => Err(refuse(
                "bc, dagger and dapg learn from a teacher: name a controller or the file of a policy (--teacher)",
            )),
            (Some(_), false) => Err(refuse(
                "only bc, dagger and dapg learn from a teacher: name none, or one of them (--algo)",
            )),
            (teacher, _) => Ok(teacher.as_ref()),
        }
    }

    /// The same with one setting changed: `key` is its path in the file, such as `learning.fit.rate`; `value` is TOML, or else text.
    ///
    /// # Errors
    /// There is no such setting, or it cannot have this value.
    pub fn with(&self, key: &str, value: &str) -> Result<Self, PolicyError> {
        let fail = |message: String| PolicyError::Setting { key: key.into(), message };
        let value = value.parse().unwrap_or_else(|_| Value::from(value));
        let mut table = self.table().map_err(fail)?;
        set(&mut table, &key.split('.').collect::<Vec<_>>(), value, false).map_err(fail)?;
        let config: Config =
            table.try_into().map_err(|error: toml::de::Error| fail(error.message().into()))?;
        config.learning.check().map_err(fail)?;
        Ok(config)
    }

    /// Every setting: its path in the file, and its value as TOML writes it.
    ///
    /// # Errors
    /// A number is greater than the file can have.
    pub fn settings(&self) -> Result<BTreeMap<String, String>, PolicyError> {
        let fail = |message| PolicyError::Content { path: None, message };
        let mut found = BTreeMap::new();
        list(&self.table().map_err(fail)?, "", &mut found);
        Ok(found)
    }

    /// What the file has; through its text, whose numbers are as short as they can be.
    fn table(&self) -> Result<Table, String> {
        let text = toml::to_string(self).map_err(|error| error.to_string())?;
        text.parse().map_err(|error: toml::de::Error| error.message().into())
    }

    /// Writes a file, at once or not at all.
    pub(super) fn write(&self, path: &Path) -> Result<(), PolicyError> {
        let text = toml::to_string(self).map_err(|error| PolicyError::run(path, error))?;
        let unfinished = path.with_extension("unfinished");
        let keep = || std::fs::write(&unfinished, text).and_then(|()| std::fs::rename(&unfinished, path));
        keep().map_err(|error| PolicyError::run(path, error))
    }
}

/// Sets what stands at a path of names. An environment's setting may be new here: the environment says which it has.
fn set(table: &mut Table, path: &[&str], value: Value, may_add: bool) -> Result<(), String> {
    let Some((name, rest)) = path.split_first() else { return Ok(()) };
    if !table.contains_key(*name) && (name.is_empty() || !may_add) {
        let names: Vec<_> = table.keys().map(String::as_str).collect();
        return Err(format!("there is no {name:?} among {}", names.join(", ")));
    }
    if rest.is_empty() {
        table.insert((*name).to_owned(), value);
        return Ok(());
    }
    match table.entry(*name).or_insert_with(|| Table::new().into()) {
        Value::Table(inner) => set(inner, rest, value, may_add || *name == "environment"),
        other => Err(format!("{name} is {other}, and has no settings of its own")),
    }
}

fn list(table: &Table, before: &str, found: &mut BTreeMap<String, String>) {
    for (name, value) in table {
        let path = format!("{before}{name}");
        match value {
            Value::Table(inner) => list(inner, &format!("{path}."), found),
            value => _ = found.insert(path, value.to_string()),
        }
    }
}
