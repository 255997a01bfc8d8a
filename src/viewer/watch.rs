//! Numbers of a simulation by the names of their arrays.

use physics::{Data, Model};
use std::fmt;

/// Why a number cannot be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WatchError {
    /// No array has this name; the nearest one has that.
    Field {
        /// What was asked for.
        name: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// The array is shorter.
    Index {
        /// The array.
        name: String,
        /// What was asked for.
        index: usize,
        /// How many numbers it has now.
        len: usize,
    },
}

impl fmt::Display for WatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WatchError::Field { name, nearest: Some(nearest) } => {
                write!(f, "no array \"{name}\"; did you mean \"{nearest}\"?")
            }
            WatchError::Field { name, nearest: None } => write!(f, "no array \"{name}\""),
            WatchError::Index { name, index, len } => write!(f, "{name} has {len} numbers, none at {index}"),
        }
    }
}

impl std::error::Error for WatchError {}

/// The number at `index` of the array `name`, such as `qpos` or `sensordata`, rows one after the other.
///
/// # Errors
/// There is no such array or number.
pub fn watch(model: &Model, data: &Data, name: &str, index: usize) -> Result<f64, WatchError> {
    let (mut found, mut names) = (None, Vec::new());
    data.visit(model, &mut |field, _, values| {
        if field == name {
            found = Some((values.to_f64().get(index).copied(), values.len()));
        }
        names.push(field);
    });
    match found {
        Some((Some(value), _)) => Ok(value),
        Some((None, len)) => Err(WatchError::Index { name: name.to_owned(), index, len }),
        None => {
            let nearest =
                physics::model::Suggestions::default().nearest(name, names.into_iter()).map(str::to_owned);
            Err(WatchError::Field { name: name.to_owned(), nearest })
        }
    }
}
