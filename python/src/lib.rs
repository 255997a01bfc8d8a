//! The extension module `robohive._core`: what the Python package calls.

mod actions;
mod arrays;
mod env;
mod exceptions;
mod infos;
mod own_state;
mod request;
mod settings;
mod world;

use pyo3::pymodule;

/// Environments of RoboHive in Rust.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::env::PyEnv;
    use ::env::Registry;
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
