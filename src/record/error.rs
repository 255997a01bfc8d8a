//! What can go wrong between an episode and its recording.

use dataset::trace::TraceError;
use env::EnvError;
use std::fmt;

/// What went wrong.
#[derive(Debug)]
pub enum RecordError {
    /// The file is damaged or cannot be written.
    Trace(TraceError),
    /// An image of the environment cannot be drawn.
    Env(Box<EnvError>),
    /// An attribute of the file, or its absence, leaves the environment open.
    Description(String),
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RecordError::Trace(error) => write!(f, "{error}"),
            RecordError::Env(error) => write!(f, "{error}"),
            RecordError::Description(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for RecordError {}

impl From<TraceError> for RecordError {
    fn from(error: TraceError) -> Self {
        RecordError::Trace(error)
    }
}

impl From<EnvError> for RecordError {
    fn from(error: EnvError) -> Self {
        RecordError::Env(Box::new(error))
    }
}
