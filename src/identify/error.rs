//! Why parameters are not identified, with the way out.

use dataset::NpzError;
use mjcf::diagnostic::Diagnostics;
use physics::StepError;
use physics::model::EditError;
use std::fmt;

/// Why parameters are not identified.
#[derive(Debug)]
#[non_exhaustive]
pub enum IdentifyError {
    /// The archive of a log cannot be read.
    Archive {
        /// The log.
        log: String,
        /// What is wrong with it.
        error: NpzError,
    },
    /// A column of a log is missing, or is not what the model takes.
    Column {
        /// The log.
        log: String,
        /// The column.
        column: String,
        /// What is wrong, and how to put it right.
        reason: String,
    },
    /// What is asked to be fitted is not there, or cannot be.
    Choice(String),
    /// The model refuses a value.
    Edit {
        /// The parameters, with their values.
        values: String,
        /// Why.
        error: EditError,
    },
    /// The model cannot be simulated with the values it has.
    Step {
        /// The log.
        log: String,
        /// Simulation time \[s\].
        time: f64,
        /// Why.
        error: StepError,
    },
    /// The description refuses the values.
    Description(Diagnostics),
}

impl IdentifyError {
    /// A column of a log that is wrong.
    pub(crate) fn column(log: &str, column: &str, reason: impl Into<String>) -> Self {
        IdentifyError::Column { log: log.into(), column: column.into(), reason: reason.into() }
    }
}

impl fmt::Display for IdentifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            IdentifyError::Archive { log, error } => write!(f, "{log}: {error}"),
            IdentifyError::Column { log, column, reason } => write!(f, "{log}, {column}: {reason}"),
            IdentifyError::Choice(reason) => f.write_str(reason),
            IdentifyError::Edit { values, error } => write!(f, "with {values}: {error}"),
            IdentifyError::Step { log, time, error } => write!(
                f,
                "{log}: the simulation fails at {time:.4} s, before anything is fitted: {error}; begin with values nearer to the \
                 robot's, or restart it from recorded states by shorter windows"
            ),
            IdentifyError::Description(diagnostics) => write!(f, "{diagnostics}"),
        }
    }
}

impl std::error::Error for IdentifyError {}

impl From<Diagnostics> for IdentifyError {
    fn from(diagnostics: Diagnostics) -> Self {
        IdentifyError::Description(diagnostics)
    }
}
