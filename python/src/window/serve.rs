//! The process of a window.

use pyo3::prelude::*;

/// Opens the window that the program at the other end of the standard streams asks for, and returns when it is closed.
#[cfg(feature = "window")]
#[pyfunction]
pub fn serve_window(py: Python<'_>) -> PyResult<()> {
    py.detach(|| viewer::window::serve(std::io::stdin(), std::io::stdout()))
        .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
}

/// Says that there is no window.
#[cfg(not(feature = "window"))]
#[pyfunction]
pub fn serve_window() -> PyResult<()> {
    Err(pyo3::exceptions::PyNotImplementedError::new_err(
        "this wheel was built without windows; `maturin build --features window` builds one that has them",
    ))
}
