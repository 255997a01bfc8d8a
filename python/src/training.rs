//! `robohive._core.Run`: trainings in folders.

use crate::env::PyEnv;
use crate::policy::raised;
use crate::settings::{python, table};
use crate::turns::Turns;
use agents::PolicyError;
use agents::learn::{Algorithm, Settings};
use agents::run::{COLUMNS, Config, Row, Run};
use agents::sweep::{Variation, combinations};
use env::Env;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use std::path::PathBuf;

/// A training in a folder.
#[pyclass(frozen, name = "Run", module = "robohive._core")]
pub struct PyRun(Turns<Run>);

#[pymethods]
impl PyRun {
    /// Begins a run of a configuration in a new or empty folder, with what its teacher shows, on environments like `env`.
    #[staticmethod]
    fn create(
        py: Python<'_>,
        env: &PyEnv,
        folder: PathBuf,
        config: &Bound<'_, PyDict>,
        threads: usize,
    ) -> PyResult<Self> {
        let config = configuration(config)?;
        let begin = |env: &mut Env| Run::create(&folder, config, env, threads, |_| ());
        Self::of(py, env.detached(py, "create", begin)?)
    }

    /// Goes on with the run in a folder, on environments like `env`.
    #[staticmethod]
    fn resume(py: Python<'_>, env: &PyEnv, folder: PathBuf, threads: usize) -> PyResult<Self> {
        let go_on = |env: &mut Env| Run::resume(&folder, env, threads);
        Self::of(py, env.detached(py, "resume", go_on)?)
    }

    /// Makes an iteration: its row of the log.
    fn iterate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let mut taken = self.0.take(py, "iterate")?;
        let run = &mut *taken;
        let row = py.detach(|| run.iterate()).map_err(|error| raised(py, &error))?;
        columns(py, &row)
    }

    /// Keeps the state.
    fn keep(&self, py: Python<'_>) -> PyResult<()> {
        let mut taken = self.0.take(py, "keep")?;
        let run = &mut *taken;
        py.detach(|| run.keep()).map_err(|error| raised(py, &error))
    }

    /// Iterations made, and to be made.
    fn iterations(&self, py: Python<'_>) -> PyResult<(u64, u64)> {
        let run = self.0.take(py, "iterations")?;
        Ok((run.iterations(), run.config().iterations))
    }

    /// Changes how many iterations are to be made.
    fn extend(&self, py: Python<'_>, iterations: u64) -> PyResult<()> {
        self.0.take(py, "extend")?.extend(iterations).map_err(|error| raised(py, &error))
    }
}

impl PyRun {
    fn of(py: Python<'_>, run: Result<Run, PolicyError>) -> PyResult<Self> {
        run.map(|run| PyRun(Turns::of(run))).map_err(|error| raised(py, &error))
    }
}

/// Names of the algorithms.
#[pyfunction]
pub fn learning_algorithms() -> [&'static str; Algorithm::NAMES.len()] {
    Algorithm::NAMES.map(|(name, _)| name)
}

/// Settings to begin with, of an algorithm by name.
#[pyfunction]
pub fn learning_settings<'py>(py: Python<'py>, algorithm: &str) -> PyResult<Bound<'py, PyAny>> {
    let settings = Settings::named(algorithm).ok_or_else(|| {
        let names = Algorithm::NAMES.map(|(name, _)| name).join(", ");
        PyValueError::new_err(format!("algorithm is one of {names}, not {algorithm:?}"))
    })?;
    as_python(py, &settings)
}

/// A configuration, parsed and written again.
#[pyfunction]
pub fn complete_config<'py>(py: Python<'py>, config: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
    as_python(py, &configuration(config)?)
}

/// A configuration for each combination of values of settings and each seed, by the name of its folder.
#[pyfunction]
pub fn config_variations<'py>(
    py: Python<'py>,
    config: &Bound<'py, PyDict>,
    vary: &Bound<'py, PyDict>,
    seeds: Vec<u64>,
) -> PyResult<Bound<'py, PyDict>> {
    let values = |(key, value): (String, toml::Value)| match value {
        toml::Value::Array(values) => {
            Ok(Variation { key, values: values.iter().map(ToString::to_string).collect() })
        }
        other => {
            Err(PyValueError::new_err(format!("{key} varies over a list of values, and {other} is none")))
        }
    };
    let variations = table(vary)?.into_iter().map(values).collect::<PyResult<Vec<_>>>()?;
    let combinations = combinations(&configuration(config)?, &variations, seeds.len());
    let found = PyDict::new(py);
    for combination in combinations.map_err(|error| raised(py, &error))? {
        for &seed in &seeds {
            let config = Config { seed, ..combination.config.clone() };
            found.set_item(combination.folder(seed), as_python(py, &config)?)?;
        }
    }
    Ok(found)
}

/// The configuration of the run in a folder.
#[pyfunction]
pub fn run_config(py: Python<'_>, folder: PathBuf) -> PyResult<Bound<'_, PyAny>> {
    as_python(py, &Run::config_of(&folder).map_err(|error| raised(py, &error))?)
}

/// The rows of the log of the run in a folder.
#[pyfunction]
pub fn run_rows(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let rows = Run::rows_of(&folder).map_err(|error| raised(py, &error))?;
    rows.iter().map(|row| columns(py, row)).collect()
}

/// The file of the policy of the run in a folder.
#[pyfunction]
pub fn run_policy(folder: PathBuf) -> PathBuf {
    Run::policy_of(&folder)
}

fn configuration(config: &Bound<'_, PyDict>) -> PyResult<Config> {
    table(config)?.try_into().map_err(not_toml)
}

fn not_toml(error: toml::de::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn as_python<'py>(py: Python<'py>, what: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    // Through text, whose numbers of single precision are as short as they can be.
    let text = toml::to_string(what).map_err(|error| PyValueError::new_err(error.to_string()))?;
    python(py, &toml::Value::Table(text.parse().map_err(not_toml)?))
}

fn columns<'py>(py: Python<'py>, row: &Row) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    COLUMNS.iter().zip(row.0).try_for_each(|(name, number)| dict.set_item(name, number))?;
    Ok(dict)
}
