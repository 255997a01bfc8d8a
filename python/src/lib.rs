//! The extension module `robohive._core`: what the Python package calls.

mod actions;
mod arrays;
mod control;
mod data;
mod env;
mod exceptions;
mod film;
mod infos;
mod live;
mod mujoco;
mod own_state;
mod policy;
mod request;
mod settings;
mod training;
mod turns;
mod vector;
mod window;
mod world;

use pyo3::pymodule;

/// Environments of RoboHive in Rust.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::control::{PyController, controllers};
    #[pymodule_export]
    use super::env::PyEnv;
    #[pymodule_export]
    use super::film::write_video;
    #[pymodule_export]
    use super::policy::{PyPolicy, policies};
    #[pymodule_export]
    use super::training::{
        PyRun, complete_config, config_variations, learning_algorithms, learning_settings, run_config,
        run_policy, run_rows,
    };
    #[pymodule_export]
    use super::vector::PyVecEnv;
    #[pymodule_export]
    use super::window::{PyWindow, effect_names, serve_window};
    use ::env::Registry;
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::data::{
        LeRobotFrames, LeRobotWriter, MinariWriter, Trace, TraceWriter, convert_trace, env_spec,
        export_lerobot, export_minari, repair_trace,
    };
    #[pymodule_export]
    use crate::mujoco::bindings;

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// Whether there are windows.
    #[pymodule_export]
    const HAS_WINDOWS: bool = cfg!(feature = "window");

    /// Ids with the names of their suites and the steps of an episode, in the registry's order.
    #[pyfunction]
    fn ids() -> Vec<(String, String, usize)> {
        let row = |spec: &::env::Spec| (spec.id.clone(), spec.suite.clone(), spec.max_episode_steps);
        Registry::builtin().specs().iter().map(row).collect()
    }

    /// Steps of an episode of an id.
    #[pyfunction]
    fn horizon(py: Python<'_>, id: &str) -> PyResult<usize> {
        let spec = Registry::builtin().spec(id).map_err(|error| super::exceptions::exception(py, &error))?;
        Ok(spec.max_episode_steps)
    }
}
