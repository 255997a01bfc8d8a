//! Errors of environments as the exceptions that users of Gymnasium and numpy expect.

use env::{EnvError, NotReady};
use pyo3::exceptions::{PyFileNotFoundError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use robot::RobotError;
use std::fmt;

/// The exception for an error of an environment, with its text.
///
/// | error | exception |
/// |---|---|
/// | unknown id | `gymnasium.error.NameNotFound` |
/// | a step that needs a reset first | `gymnasium.error.ResetNeeded` |
/// | a setting that is unknown or wrong | `robohive.SettingError`, a `ValueError` and a `TypeError` |
/// | a device of a robot that is hardware fails, or nothing drives it | `robohive.HardwareError`, a `RuntimeError` |
/// | the function that prepares an episode raises | what it raises |
/// | physics refuses a state | `robohive.PhysicsError`, a `RuntimeError` |
/// | a fault of this program; threads that do not start | `RuntimeError` |
/// | one of these in one environment of many | as without the others |
/// | missing models and weights | `FileNotFoundError` |
/// | all else: actions, states, pictures, models | `ValueError` |
pub fn exception(py: Python<'_>, error: &EnvError) -> PyErr {
    with_text(py, error, error.to_string())
}

fn with_text(py: Python<'_>, error: &EnvError, text: String) -> PyErr {
    match error {
        EnvError::InBatch { error, .. } => with_text(py, error, text),
        EnvError::Panicked { .. } | EnvError::Threads { .. } => PyRuntimeError::new_err(text),
        EnvError::UnknownId { .. } => named(py, "gymnasium.error", "NameNotFound", text),
        EnvError::NeedsReset => named(py, "gymnasium.error", "ResetNeeded", text),
        EnvError::Setting { .. } => named(py, "robohive.errors", "SettingError", text),
        EnvError::Robot(RobotError::Device { device, fault }) => of_device(py, device, fault.kind(), text),
        EnvError::Robot(RobotError::Interface { device, .. }) => of_device(py, device, "", text),
        EnvError::NotReady(why) => {
            raised(py, why).unwrap_or_else(|| named(py, "robohive.errors", "HardwareError", text))
        }
        EnvError::Camera { .. } => named(py, "robohive.errors", "HardwareError", text),
        EnvError::Physics(_) => named(py, "robohive.errors", "PhysicsError", text),
        EnvError::MissingFile { .. } | EnvError::Network { .. } => PyFileNotFoundError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// The exception for a call of an environment that was closed: `gymnasium.error.ClosedEnvironmentError`.
pub fn closed(py: Python<'_>, call: &str) -> PyErr {
    let text = format!("{call} was called on a closed environment; make another");
    named(py, "gymnasium.error", "ClosedEnvironmentError", text)
}

/// An exception of the function that prepares an episode, on its way through an environment.
#[derive(Debug)]
pub struct Raised(pub PyErr);

impl fmt::Display for Raised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Raised {}

/// The exception that the function raised which prepares an episode, if that is the error.
fn raised(py: Python<'_>, error: &NotReady) -> Option<PyErr> {
    error.downcast_ref::<Raised>().map(|raised| raised.0.clone_ref(py))
}

/// The exception for a device that failed, which has its name as `device` and what failed as `kind`.
fn of_device(py: Python<'_>, device: &str, kind: &str, text: String) -> PyErr {
    let made = py
        .import("robohive.errors")
        .and_then(|module| module.getattr("HardwareError")?.call1((&text, device, kind)));
    made.map_or_else(|_| PyRuntimeError::new_err(text), PyErr::from_value)
}

/// An exception of a Python module; a `RuntimeError` where Gymnasium is not installed.
fn named(py: Python<'_>, module: &str, class: &str, text: String) -> PyErr {
    let made = py.import(module).and_then(|module| module.getattr(class)?.call1((&text,)));
    made.map_or_else(|_| PyRuntimeError::new_err(text), PyErr::from_value)
}
