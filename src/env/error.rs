//! What can be wrong with an environment, in whole sentences.

use physics::StepError;
use physics::model::{EditError, Suggestions};
use random::RandomError;
use render::RenderError;
use robot::{ConfigError, RobotError};
use std::fmt;

/// What must be done before an episode can begin failed: why.
pub type NotReady = Box<dyn std::error::Error + Send + Sync>;

/// Why an environment could not be made, reset or stepped.
#[derive(Debug)]
#[non_exhaustive]
pub enum EnvError {
    /// No environment has this id.
    UnknownId {
        /// What was asked for.
        id: String,
        /// The id nearest to it.
        nearest: Option<String>,
    },
    /// A file that the id needs is not there.
    MissingFile {
        /// The id.
        id: String,
        /// The file as the registry names it.
        path: String,
        /// How to get it.
        hint: String,
    },
    /// The model does not load.
    Model {
        /// The file.
        path: String,
        /// All findings, each with its place.
        diagnostics: Box<mjcf::diagnostic::Diagnostics>,
    },
    /// A setting has a wrong type or value, or is unknown.
    Setting {
        /// The id.
        id: String,
        /// What is wrong, and where.
        message: String,
    },
    /// A table of environments is malformed.
    Table {
        /// What is wrong, and in which row.
        message: String,
    },
    /// The model lacks an element that the task names.
    Element {
        /// Kind of element.
        kind: &'static str,
        /// Name asked for.
        name: String,
        /// The nearest name of that kind.
        nearest: Option<String>,
    },
    /// An action of the wrong length.
    ActionLength {
        /// Values that the environment takes.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// An action that holds NaN or an infinity.
    ActionValue {
        /// Where it stands.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Actions of agents that do not fit the agents of an environment.
    Agents {
        /// Which agent, and what is wrong with its action.
        message: String,
    },
    /// A step after the end of an episode that only a reset can continue.
    NeedsReset,
    /// The surroundings of a robot that is hardware could not be prepared for an episode: why.
    NotReady(NotReady),
    /// Physics refuses the state.
    Physics(StepError),
    /// The robot's configuration is malformed.
    Config(ConfigError),
    /// The model cannot be what a task makes of it.
    Edit(EditError),
    /// The robot refuses its configuration or an action.
    Robot(RobotError),
    /// A range or population that cannot be drawn from.
    Draw(RandomError),
    /// A saved state of another environment.
    ForeignState {
        /// What does not fit.
        message: String,
    },
    /// The model, a camera or a size cannot be drawn.
    Render(RenderError),
    /// An error of one environment among many.
    InBatch {
        /// Which one.
        index: usize,
        /// Its error.
        error: Box<EnvError>,
    },
    /// Environments of a batch that do not exist or are not at hand.
    Selection {
        /// Which, and why.
        message: String,
    },
    /// An environment met a fault of this program, and cannot go on.
    Panicked {
        /// What the fault says of itself.
        message: String,
    },
    /// Threads cannot be started.
    Threads {
        /// What the system says.
        message: String,
    },
    /// A camera of a robot on hardware is missing, or has no frame.
    Camera {
        /// Which, and why.
        message: String,
    },
    /// A visual key needs a network that is not there.
    Network {
        /// The visual key.
        key: String,
        /// Which file to bring, and where to put it.
        message: String,
    },
}

impl EnvError {
    /// The model has no element of this kind and name; the nearest of `names` is suggested.
    pub fn missing<'a>(kind: &'static str, name: &str, names: impl Iterator<Item = &'a str>) -> Self {
        let nearest = Suggestions::default().nearest(name, names).map(str::to_owned);
        EnvError::Element { kind, name: name.to_string(), nearest }
    }
}

impl fmt::Display for EnvError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EnvError::UnknownId { id, nearest } => {
                write!(
                    f,
                    "there is no environment {id}{}; `robohive list` shows all",
                    suggestion(nearest.as_deref())
                )
            }
            EnvError::MissingFile { id, path, hint } => {
                write!(f, "{id} needs {path}, which is not here: {hint}")
            }
            EnvError::Model { path, diagnostics } => {
                write!(f, "the model {path} does not load:\n{diagnostics}")
            }
            EnvError::Setting { id, message } => write!(f, "a setting of {id} is wrong: {message}"),
            EnvError::Table { message } => f.write_str(message),
            EnvError::Element { kind, name, nearest } => {
                write!(f, "the model has no {kind} named {name}{}", suggestion(nearest.as_deref()))
            }
            EnvError::ActionLength { expected, found } => {
                write!(f, "an action has {expected} values here, and {found} were given")
            }
            EnvError::ActionValue { index, value } => {
                write!(f, "value {index} of the action is {value}; actions are finite numbers")
            }
            EnvError::NeedsReset => {
                write!(f, "physics refused the last step, which ended the episode: reset first")
            }
            EnvError::NotReady(why) => write!(f, "the episode cannot begin: {why}"),
            EnvError::Camera { message } | EnvError::Agents { message } => f.write_str(message),
            EnvError::Physics(error) => write!(f, "{error}"),
            EnvError::Config(error) => write!(f, "{error}"),
            EnvError::Edit(error) => write!(f, "{error}"),
            EnvError::Robot(error) => write!(f, "{error}"),
            EnvError::Draw(error) => write!(f, "{error}"),
            EnvError::ForeignState { message } => write!(f, "the saved state does not fit: {message}"),
            EnvError::Render(error) => write!(f, "{error}"),
            EnvError::InBatch { index, error } => write!(f, "environment {index}: {error}"),
            EnvError::Selection { message } => write!(f, "{message}"),
            EnvError::Panicked { message } => {
                write!(f, "a fault of this program, please report it: {message}; make the environments again")
            }
            EnvError::Threads { message } => write!(f, "no threads can be started: {message}"),
            EnvError::Network { key, message } => write!(f, "{key} cannot be encoded: {message}"),
        }
    }
}

impl std::error::Error for EnvError {}

impl From<StepError> for EnvError {
    fn from(error: StepError) -> Self {
        EnvError::Physics(error)
    }
}

impl From<EditError> for EnvError {
    fn from(error: EditError) -> Self {
        EnvError::Edit(error)
    }
}

impl From<RobotError> for EnvError {
    fn from(error: RobotError) -> Self {
        EnvError::Robot(error)
    }
}

impl From<ConfigError> for EnvError {
    fn from(error: ConfigError) -> Self {
        EnvError::Config(error)
    }
}

impl From<RenderError> for EnvError {
    fn from(error: RenderError) -> Self {
        EnvError::Render(error)
    }
}

impl From<RandomError> for EnvError {
    fn from(error: RandomError) -> Self {
        EnvError::Draw(error)
    }
}

fn suggestion(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |nearest| format!("; did you mean {nearest}?"))
}

/// What a caught panic said.
pub fn panic_text(payload: &(dyn std::any::Any + Send)) -> String {
    let borrowed = payload.downcast_ref::<&str>().map(ToString::to_string);
    let text = borrowed.or_else(|| payload.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "a panic without a text".into())
}
