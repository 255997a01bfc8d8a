//! Errors of teleoperation.

use agents::PolicyError;
use env::EnvError;
use record::RecordError;
use robot::RobotError;
use std::fmt;
use std::path::PathBuf;

/// An error of teleoperation.
#[derive(Debug)]
#[non_exhaustive]
pub enum TeleopError {
    /// A mapping, calibration or leader file is not valid.
    Mapping {
        /// The file, or a name for built-in text.
        file: String,
        /// What is wrong, and how to fix it.
        message: String,
    },
    /// The environment cannot be driven this way.
    Control {
        /// What is missing, and what to do.
        message: String,
    },
    /// A device cannot be opened or read.
    Device {
        /// Name of the device.
        device: String,
        /// Its path, where it has one.
        path: Option<PathBuf>,
        /// What happened.
        message: String,
        /// What to do.
        fix: String,
    },
    /// The environment refuses.
    Env(Box<EnvError>),
    /// The robot refuses.
    Robot(Box<RobotError>),
    /// The policy refuses.
    Policy(Box<PolicyError>),
    /// The episode cannot be kept.
    Record(Box<RecordError>),
}

impl fmt::Display for TeleopError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TeleopError::Mapping { file, message } => write!(f, "{file}: {message}"),
            TeleopError::Control { message } => f.write_str(message),
            TeleopError::Device { device, path, message, fix } => {
                write!(f, "{device}")?;
                if let Some(path) = path {
                    write!(f, " ({})", path.display())?;
                }
                write!(f, ": {message}; {fix}")
            }
            TeleopError::Env(error) => write!(f, "{error}"),
            TeleopError::Robot(error) => write!(f, "{error}"),
            TeleopError::Policy(error) => write!(f, "{error}"),
            TeleopError::Record(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for TeleopError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            TeleopError::Env(error) => Some(error),
            TeleopError::Robot(error) => Some(error),
            TeleopError::Policy(error) => Some(error),
            TeleopError::Record(error) => Some(error),
            _ => None,
        }
    }
}

impl From<EnvError> for TeleopError {
    fn from(error: EnvError) -> Self {
        TeleopError::Env(Box::new(error))
    }
}

impl From<RobotError> for TeleopError {
    fn from(error: RobotError) -> Self {
        TeleopError::Robot(Box::new(error))
    }
}

impl From<PolicyError> for TeleopError {
    fn from(error: PolicyError) -> Self {
        TeleopError::Policy(Box::new(error))
    }
}

impl From<RecordError> for TeleopError {
    fn from(error: RecordError) -> Self {
        TeleopError::Record(Box::new(error))
    }
}
