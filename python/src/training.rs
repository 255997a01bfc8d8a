//! `robohive._core.Run`: trainings in folders.

use crate::env::PyEnv;
use crate::policy::raised;
use crate::settings::{python, table};
use crate::turns::Turns;
use agents::PolicyError;
use agents::learn::{Algorithm, Demonstrations, Settings, Teacher};
use agents::run::{COLUMNS, Config, Row, Run, Teaching};
use control::Controller;
use env::Env;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Environments that each thread steps side by side.
const SIDE_BY_SIDE: usize = 16;

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
        let begin = |env: &mut Env| {
            let demonstrations = shown(&config, env)?;
            let mut run = Run::create(&folder, config, env, [SIDE_BY_SIDE, cores(threads)])?;
            demonstrations.map_or(Ok(()), |shown| run.teach(shown))?;
            correct(&mut run)?;
            Ok(run)
        };
        Self::of(py, env.detached(py, "create", begin)?)
    }

    /// Goes on with the run in a folder, on environments like `env`.
    #[staticmethod]
    fn resume(py: Python<'_>, env: &PyEnv, folder: PathBuf, threads: usize) -> PyResult<Self> {
        let go_on = |env: &mut Env| {
            let mut run = Run::resume(&folder, env, [SIDE_BY_SIDE, cores(threads)])?;
            correct(&mut run)?;
            Ok(run)
        };
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

/// Settings to begin with, of an algorithm by name.
#[pyfunction]
pub fn learning_settings<'py>(py: Python<'py>, algorithm: &str) -> PyResult<Bound<'py, PyAny>> {
    let settings = Settings::named(algorithm).ok_or_else(|| {
        let names = Algorithm::NAMES.join(", ");
        PyValueError::new_err(format!("algorithm is one of {names}, not {algorithm:?}"))
    })?;
    as_python(py, &settings)
}

/// A configuration, parsed and written again.
#[pyfunction]
pub fn complete_config<'py>(py: Python<'py>, config: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
    as_python(py, &configuration(config)?)
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
    let wrong = |error: toml::de::Error| PyValueError::new_err(error.to_string());
    table(config)?.try_into().map_err(wrong)
}

fn as_python<'py>(py: Python<'py>, what: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let value = toml::Value::try_from(what).map_err(|error| PyValueError::new_err(error.to_string()))?;
    python(py, &value)
}

fn columns<'py>(py: Python<'py>, row: &Row) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    COLUMNS.iter().zip(row.0).try_for_each(|(name, number)| dict.set_item(name, number))?;
    Ok(dict)
}

fn cores(threads: usize) -> usize {
    match threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        threads => threads,
    }
}

/// What the teacher of a configuration shows; none where nothing is learnt from it.
fn shown(config: &Config, env: &Env) -> Result<Option<Demonstrations>, PolicyError> {
    let id = || env.spec().id.clone();
    match (&config.teacher, config.learning.algorithm.needs_demonstrations()) {
        (None, false) => Ok(None),
        (Some(Teaching { by, lessons }), true) => {
            let (mut env, mut teacher) = (env.fork()?, teacher(by, env)?);
            Demonstrations::play(&mut env, &mut *teacher, *lessons, config.seed, |_| ()).map(Some)
        }
        (None, true) => {
            let message = "this algorithm learns from a teacher: name one".into();
            Err(PolicyError::Teacher { id: id(), message })
        }
        (Some(_), false) => {
            let message = "this algorithm learns from no teacher: name none".into();
            Err(PolicyError::Teacher { id: id(), message })
        }
    }
}

/// Lets the teacher of a run correct what its policy does, where that is learnt from.
fn correct(run: &mut Run) -> Result<(), PolicyError> {
    match run.config().teacher.clone() {
        Some(Teaching { by, .. }) if run.config().learning.algorithm.needs_corrections() => {
            run.correct(|env| teacher(&by, env))
        }
        _ => Ok(()),
    }
}

/// The teacher of a name: a controller, or the file of a policy.
fn teacher(name: &str, env: &Env) -> Result<Box<dyn Teacher + Send>, PolicyError> {
    if control::controllers().iter().any(|entry| entry.name == name) {
        let made = control::make(name, env).map_err(|error| failed(env, error))?;
        return Ok(Box::new(Solver(made)));
    }
    Ok(Box::new(agents::Policy::open(Path::new(name))?))
}

/// A controller as a teacher.
struct Solver(Box<dyn Controller>);

impl Teacher for Solver {
    fn begin(&mut self, env: &Env, seed: u64) -> Result<(), PolicyError> {
        self.0.reset(env, seed).map_err(|error| failed(env, error))
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        self.0.act(env, action).map_err(|error| failed(env, error))
    }
}

fn failed(env: &Env, error: control::ControlError) -> PolicyError {
    PolicyError::Teacher { id: env.spec().id.clone(), message: error.to_string() }
}
