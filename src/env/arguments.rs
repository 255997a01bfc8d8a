//! Settings by their names.

use crate::message::message;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;
use toml::Table;

message! {
    /// A text that is no list of settings, or a value that no setting can have.
    ArgumentsError
}

/// Settings by their names: numbers, texts, lists, and settings within settings. They are read from TOML or given one by
/// one.
///
/// ```
/// use robohive_env::Arguments;
///
/// let read: Arguments = "frame_skip = 10\nobs_keys = ['qp', 'qv']".parse()?;
/// let given = Arguments::default().with("frame_skip", 10)?.with("obs_keys", ["qp", "qv"])?;
/// assert_eq!(read, given);
/// assert_eq!(read.get("frame_skip"), Some(10));
/// # Ok::<(), robohive_env::ArgumentsError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Arguments(pub(crate) Table);

impl Arguments {
    /// The same with this setting, which replaces one of that name.
    ///
    /// # Errors
    /// A value that no setting can have, such as an integer beyond 64 bits.
    pub fn with(mut self, name: &str, value: impl Serialize) -> Result<Self, ArgumentsError> {
        let value = toml::Value::try_from(value).map_err(|error| error.to_string())?;
        self.0.insert(name.to_owned(), value);
        Ok(self)
    }

    /// The value of a setting; `None` where it is missing or of another type.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Option<T> {
        self.0.get(name)?.clone().try_into().ok()
    }

    /// Whether a setting of this name is among them.
    pub fn contains(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Takes a setting away; whether it was there.
    pub fn remove(&mut self, name: &str) -> bool {
        self.0.remove(name).is_some()
    }

    /// Adds the settings of `others`; they replace settings of the same names.
    pub fn extend(&mut self, others: Arguments) {
        self.0.extend(others.0);
    }

    /// Every setting: its name, and its value as TOML writes it.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, String)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value.to_string()))
    }
}

impl FromStr for Arguments {
    type Err = ArgumentsError;

    fn from_str(text: &str) -> Result<Self, ArgumentsError> {
        text.parse().map(Arguments).map_err(|error: toml::de::Error| error.message().into())
    }
}

/// As TOML, one setting a line.
impl fmt::Display for Arguments {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
