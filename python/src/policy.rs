//! `robohive._core.Policy`: what was trained.

use crate::env::PyEnv;
use crate::exceptions::exception;
use crate::turns::Turns;
use agents::{Policy, PolicyError};
use numpy::PyArray1;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A policy of an environment, whose observation it sees in every call.
#[pyclass(frozen, name = "Policy", module = "robohive._core")]
pub struct PyPolicy(Turns<Policy>);

#[pymethods]
impl PyPolicy {
    /// Reads a file; the policy that is shipped for an id, without one.
    #[new]
    fn new(py: Python<'_>, id: &str, file: Option<PathBuf>) -> PyResult<Self> {
        let policy = match file {
            Some(file) => Policy::open(file),
            None => Policy::best(id),
        };
        Ok(PyPolicy(Turns::of(policy.map_err(|error| raised(py, &error))?)))
    }

    /// The action for the present observation.
    fn act<'py>(&self, py: Python<'py>, env: &PyEnv) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut taken = self.0.take(py, "act")?;
        let policy = &mut *taken;
        let action = env.detached(py, "act", |env| {
            let mut action = vec![0.0; env.action_len()];
            policy.action(env, &mut action).map(|()| action)
        })?;
        Ok(PyArray1::from_vec(py, action.map_err(|error| raised(py, &error))?))
    }
}

/// Ids that a trained policy is shipped for.
#[pyfunction]
pub fn policies() -> Vec<&'static str> {
    assets::policies().collect()
}

/// The exception for an error of a policy, with its text.
pub fn raised(py: Python<'_>, error: &PolicyError) -> PyErr {
    match error {
        PolicyError::Env(error) => exception(py, error),
        PolicyError::File { .. } => PyOSError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}
