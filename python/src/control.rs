//! `robohive._core.Controller`: what solves tasks without learning.

use crate::env::PyEnv;
use crate::exceptions::exception;
use crate::turns::Turns;
use control::{ControlError, Controller};
use env::{EnvError, Registry};
use numpy::PyArray1;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// A controller of one environment, which it sees in every call.
#[pyclass(frozen, name = "Controller", module = "robohive._core")]
pub struct PyController(Turns<Box<dyn Controller>>);

#[pymethods]
impl PyController {
    #[new]
    fn new(py: Python<'_>, name: &str, env: &PyEnv) -> PyResult<Self> {
        let made = env.detached(py, "controller", |env| control::make(name, env))?;
        Ok(PyController(Turns::of(made.map_err(|error| raised(py, &error))?)))
    }

    /// Prepares for the episode that has just begun.
    fn reset(&self, py: Python<'_>, env: &PyEnv, seed: u64) -> PyResult<()> {
        let mut taken = self.0.take(py, "reset")?;
        let controller = &mut *taken;
        let done = env.detached(py, "reset", |env| controller.reset(env, seed))?;
        done.map_err(|error| raised(py, &error))
    }

    /// The action for the present state.
    fn act<'py>(&self, py: Python<'py>, env: &PyEnv) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut taken = self.0.take(py, "act")?;
        let controller = &mut *taken;
        let action = env.detached(py, "act", |env| {
            let mut action = vec![0.0; env.action_len()];
            controller.act(env, &mut action).map(|()| action)
        })?;
        Ok(PyArray1::from_vec(py, action.map_err(|error| raised(py, &error))?))
    }
}

/// Names and summaries of the controllers that serve an id, the best first; of all, without one.
#[pyfunction]
#[pyo3(signature = (id = None))]
pub fn controllers(py: Python<'_>, id: Option<&str>) -> PyResult<Vec<(&'static str, &'static str)>> {
    let row = |entry: &'static control::Entry| (entry.name, entry.summary);
    let Some(id) = id else { return Ok(control::controllers().iter().map(row).collect()) };
    let spec = Registry::builtin().spec(id).map_err(|error| exception(py, &error))?;
    Ok(control::serving(spec).map(row).collect())
}

/// The exception for an error of a controller, with its text.
fn raised(py: Python<'_>, error: &ControlError) -> PyErr {
    match error {
        ControlError::Env(error) => exception(py, error),
        ControlError::Step(error) => exception(py, &EnvError::Physics(error.clone())),
        ControlError::NoSolution(_) => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}
