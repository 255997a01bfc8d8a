//! Exceptions of the stand-in for `mujoco`, and what becomes one.

use physics::StepError;
use physics::model::EditError;
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use std::any::Any;

create_exception!(
    robohive.mujoco,
    FatalError,
    PyException,
    "The engine cannot go on with this model and state."
);
create_exception!(robohive.mujoco, UnexpectedError, PyException, "A fault of this package, to be reported.");

/// Why a call into the engine failed.
#[derive(Debug)]
pub enum Fault {
    /// A step or a pass was refused.
    Step(StepError),
    /// An argument that MuJoCo ends the program for; becomes a `FatalError`.
    Fatal(String),
    /// An argument does not fit; becomes a `ValueError`.
    Value(String),
    /// The engine panicked.
    Panic(String),
}

impl Fault {
    /// The panic that was caught.
    pub fn of_panic(payload: &(dyn Any + Send)) -> Self {
        Fault::Panic(env::panic_text(payload))
    }
}

impl From<StepError> for Fault {
    fn from(error: StepError) -> Self {
        Fault::Step(error)
    }
}

impl From<Fault> for PyErr {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Step(error) => FatalError::new_err(error.to_string()),
            Fault::Fatal(text) => FatalError::new_err(text),
            Fault::Value(text) => PyValueError::new_err(text),
            Fault::Panic(text) => {
                UnexpectedError::new_err(format!("{text} (a fault of robohive; please report it)"))
            }
        }
    }
}

/// An edit that the model refuses.
pub fn refused(error: &EditError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
