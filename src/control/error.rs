//! What can be wrong with a controller.

use crate::maths::NoSolution;
use env::EnvError;
use physics::StepError;
use std::fmt;

/// Why a controller cannot be made, or cannot act.
#[derive(Debug)]
#[non_exhaustive]
pub enum ControlError {
    /// There is no controller of this name.
    Unknown {
        /// The name.
        name: String,
        /// The id that it was asked for.
        id: String,
        /// Names of controllers that serve the id.
        serving: Vec<&'static str>,
    },
    /// The controller serves other tasks.
    NotServed {
        /// The controller.
        name: &'static str,
        /// The id that it was asked for.
        id: String,
        /// Tasks and ids that it serves.
        serves: &'static [&'static str],
        /// Number of feet of the bodies that it serves, if it matters.
        feet: Option<usize>,
        /// Names of controllers that serve the id.
        serving: Vec<&'static str>,
    },
    /// The environment lacks what the controller needs.
    Unfit {
        /// The environment's id.
        id: String,
        /// What is missing, and how to get it.
        message: String,
    },
    /// A method found no solution.
    NoSolution(NoSolution),
    /// Physics refuses a state on which the controller plans.
    Step(StepError),
    /// The environment cannot do what it is asked.
    Env(EnvError),
}

impl ControlError {
    /// An error about an environment that lacks something.
    pub(crate) fn unfit(env: &env::Env, message: impl Into<String>) -> Self {
        ControlError::Unfit { id: env.spec().id.clone(), message: message.into() }
    }
}

/// Which controllers would do.
fn instead(id: &str, serving: &[&str]) -> String {
    if serving.is_empty() {
        format!(
            "no controller is made for {id}; `robohive run {id} --controller planner` plans by its reward, and `--policy FILE` plays a \
             policy"
        )
    } else {
        format!("{id} is served by {}", serving.join(", "))
    }
}

impl fmt::Display for ControlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ControlError::Unknown { name, id, serving } => {
                write!(f, "there is no controller {name}; {}", instead(id, serving))
            }
            ControlError::NotServed { name, id, serves, feet, serving } => {
                let serves = serves.join(", ");
                let of = feet.map_or_else(String::new, |feet| format!(" of bodies with {feet} feet"));
                write!(f, "the controller {name} serves {serves}{of}, not {id}; {}", instead(id, serving))
            }
            ControlError::Unfit { id, message } => write!(f, "{id}: {message}"),
            ControlError::NoSolution(error) => write!(f, "{error}"),
            ControlError::Step(error) => write!(f, "{error}"),
            ControlError::Env(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for ControlError {}

impl From<NoSolution> for ControlError {
    fn from(error: NoSolution) -> Self {
        ControlError::NoSolution(error)
    }
}

impl From<StepError> for ControlError {
    fn from(error: StepError) -> Self {
        ControlError::Step(error)
    }
}

impl From<EnvError> for ControlError {
    fn from(error: EnvError) -> Self {
        ControlError::Env(error)
    }
}
