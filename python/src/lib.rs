//! The extension module `robohive._core`: what the Python package calls.

use pyo3::pymodule;

/// Environments of RoboHive in Rust.
#[pymodule]
mod _core {
    use env::Registry;
    use pyo3::prelude::*;

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// Ids with the names of their suites, in the registry's order.
    #[pyfunction]
    fn ids() -> Vec<(String, String)> {
        Registry::builtin().specs().iter().map(|spec| (spec.id.clone(), spec.suite.clone())).collect()
    }
}
