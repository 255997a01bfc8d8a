//! Errors as Python's exceptions.

use dataset::trace::TraceError;
use exchange::STOPPED;
use pyo3::exceptions::{PyFileExistsError, PyFileNotFoundError};
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::path::Path;

/// The exception of an error: `robohive.data.DataError`, whose text names file and group.
pub fn data_error(error: TraceError) -> PyErr {
    Python::attach(|py| {
        let class = py.import("robohive.data.errors").and_then(|module| module.getattr("DataError"));
        match class.and_then(|class| Ok(class.cast_into::<PyType>()?)) {
            Ok(class) => PyErr::from_type(class, error.to_string()),
            Err(failure) => failure,
        }
    })
}

/// Refuses a path where nothing is.
pub fn require(path: &Path) -> PyResult<()> {
    if path.exists() {
        Ok(())
    } else {
        Err(PyFileNotFoundError::new_err(format!("{}: no such file or folder", path.display())))
    }
}

/// Refuses a path where something is.
pub fn vacant(path: &Path, what: &str) -> PyResult<()> {
    if path.exists() {
        let message = format!("{}: {what} exists: delete it, or choose another name", path.display());
        return Err(PyFileExistsError::new_err(message));
    }
    Ok(())
}

/// Calls Python with how far work is, and keeps what it raises.
pub struct Watcher {
    callback: Option<Py<PyAny>>,
    raised: Option<PyErr>,
}

impl Watcher {
    /// One for a callable that takes the episodes that are done and all there are.
    pub fn new(callback: Option<Py<PyAny>>) -> Self {
        Watcher { callback, raised: None }
    }

    /// Says how far work is; false after an exception, `KeyboardInterrupt` included.
    pub fn report(&mut self, done: usize, total: usize) -> bool {
        let told = Python::attach(|py| {
            py.check_signals()?;
            self.callback.as_ref().map_or(Ok(()), |callback| callback.call1(py, (done, total)).map(|_| ()))
        });
        self.raised = told.err();
        self.raised.is_none()
    }

    /// The exception of work that failed: what the callable raised, if that stopped it.
    pub fn explain(&mut self, error: TraceError) -> PyErr {
        let stopped = error.message == STOPPED;
        self.raised.take().filter(|_| stopped).unwrap_or_else(|| data_error(error))
    }
}
