//! What can be wrong with a policy.

use dataset::pickle::PickleError;
use env::EnvError;
use std::fmt;
use std::path::PathBuf;

/// Why a policy cannot be read, or cannot act.
#[derive(Debug)]
#[non_exhaustive]
pub enum PolicyError {
    /// The file cannot be read.
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// The file holds no policy that is understood.
    Content {
        /// The file; `None` for bytes that came from elsewhere.
        path: Option<PathBuf>,
        /// What is wrong.
        message: String,
    },
    /// A run cannot be made or resumed.
    Run {
        /// Its folder, or a file there.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// A training has no such setting, or it cannot have this value.
    Setting {
        /// Its path in the configuration.
        key: String,
        /// What is wrong.
        message: String,
    },
    /// Runs of a sweep are too many or too much alike.
    Sweep(String),
    /// The policy is one for another environment.
    Foreign {
        /// The environment's id.
        id: String,
        /// What does not fit.
        message: String,
    },
    /// No policy is shipped for an id.
    Unshipped {
        /// The id.
        id: String,
    },
    /// A teacher does not show what is to be learnt.
    Teacher {
        /// The environment's id.
        id: String,
        /// What it does instead.
        message: String,
    },
    /// There is nothing to learn from a reward.
    Reward {
        /// The environment's id.
        id: String,
        /// The reward.
        reward: f64,
        /// The step of the episode that gave it, from 1.
        step: usize,
    },
    /// The environment cannot say what it is asked.
    Env(EnvError),
}

impl PolicyError {
    pub(crate) fn content(message: impl Into<String>) -> Self {
        PolicyError::Content { path: None, message: message.into() }
    }

    pub(crate) fn run(path: &std::path::Path, message: impl fmt::Display) -> Self {
        PolicyError::Run { path: path.into(), message: message.to_string() }
    }

    /// The same error about a file.
    pub(crate) fn within(self, file: &std::path::Path) -> Self {
        match self {
            PolicyError::Content { message, .. } => PolicyError::Content { path: Some(file.into()), message },
            other => other,
        }
    }
}

impl fmt::Display for PolicyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PolicyError::File { path, error } => write!(f, "the policy {}: {error}", path.display()),
            PolicyError::Content { path: Some(path), message } => {
                write!(f, "the policy {}: {message}", path.display())
            }
            PolicyError::Content { path: None, message } => write!(f, "the policy: {message}"),
            PolicyError::Run { path, message } => write!(f, "the run {}: {message}", path.display()),
            PolicyError::Setting { key, message } => write!(f, "the setting {key}: {message}"),
            PolicyError::Sweep(message) => write!(f, "the sweep: {message}"),
            PolicyError::Foreign { id, message } => write!(f, "the policy is not one for {id}: {message}"),
            PolicyError::Unshipped { id } => {
                let shipped = assets::policies().collect::<Vec<_>>().join(", ");
                write!(
                    f,
                    "no policy is shipped for {id}; there are some for {shipped}; `robohive train {id}` trains one"
                )
            }
            PolicyError::Teacher { id, message } => write!(f, "the teacher of {id}: {message}"),
            PolicyError::Reward { id, reward, step } => {
                write!(
                    f,
                    "{id} gave the reward {reward} at step {step} of an episode; rewards must be finite"
                )
            }
            PolicyError::Env(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for PolicyError {}

impl From<PickleError> for PolicyError {
    fn from(error: PickleError) -> Self {
        PolicyError::content(error.to_string())
    }
}

impl From<EnvError> for PolicyError {
    fn from(error: EnvError) -> Self {
        PolicyError::Env(error)
    }
}
