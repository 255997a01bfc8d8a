//! Datasets of Minari.

use super::array::{Given, take_named};
use super::failure::{Watcher, data_error, require, vacant};
use super::trace::closed;
use ::env::Registry;
use dataset::trace::TraceReader;
use exchange::Exported;
use exchange::minari::{self, About, DatasetId, Target};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::{Map, Value};
use std::path::PathBuf;
use std::sync::Mutex;

/// A dataset that is being written.
#[pyclass(frozen, module = "robohive._core")]
pub struct MinariWriter {
    writer: Mutex<Option<minari::MinariWriter>>,
}

fn id_of(id: &str) -> PyResult<DatasetId> {
    DatasetId::new(id).map_err(|error| PyValueError::new_err(error.to_string()))
}

fn entries(json: &str) -> PyResult<Map<String, Value>> {
    serde_json::from_str(json).map_err(|e| PyValueError::new_err(format!("metadata: {e}")))
}

#[pymethods]
impl MinariWriter {
    /// Makes a dataset. Spaces, the environment's spec and further metadata are JSON.
    #[new]
    fn new(
        root: PathBuf,
        id: &str,
        spaces: (String, String),
        env_spec: Option<String>,
        metadata: &str,
    ) -> PyResult<Self> {
        let id = id_of(id)?;
        vacant(&root.join(id.as_str()), "the dataset")?;
        let (observation_space, action_space) = spaces;
        let about = About { observation_space, action_space, env_spec, more: entries(metadata)? };
        let writer = minari::MinariWriter::create(&root, &id, &about).map_err(data_error)?;
        Ok(MinariWriter { writer: Mutex::new(Some(writer)) })
    }

    /// Adds an episode.
    fn add(&self, py: Python<'_>, columns: Vec<(String, Given)>, seed: Option<i64>) -> PyResult<()> {
        let columns = take_named(columns)?;
        let mut writer = self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let writer = writer.as_mut().ok_or_else(closed)?;
        py.detach(|| writer.add(&columns, seed)).map_err(data_error)
    }

    /// The folder that holds the files.
    fn folder(&self) -> PyResult<PathBuf> {
        let writer = self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        Ok(writer.as_ref().ok_or_else(closed)?.folder().to_owned())
    }

    /// Completes the dataset.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let writer = self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
        py.detach(|| writer.map_or(Ok(()), minari::MinariWriter::close)).map_err(data_error)
    }
}

/// Episodes, steps, folder, and what has no place in the dataset, and why.
pub type Report = (usize, usize, PathBuf, Vec<(String, String)>);

/// What came of an export, for Python.
pub fn report(done: Exported) -> Report {
    (done.episodes, done.steps, done.folder, done.dropped)
}

/// Makes a dataset of a recording. `entries` are the JSON of the space of observations, of the space of actions, of the
/// environment's spec, and of further metadata.
#[pyfunction]
pub fn export_minari(
    py: Python<'_>,
    source: PathBuf,
    root: PathBuf,
    id: &str,
    infos: bool,
    entries: (Option<String>, Option<String>, Option<String>, String),
    progress: Option<Py<PyAny>>,
) -> PyResult<Report> {
    require(&source)?;
    let id = id_of(id)?;
    vacant(&root.join(id.as_str()), "the dataset")?;
    let (observations, actions, env_spec, metadata) = entries;
    let more = self::entries(&metadata)?;
    let target = Target { root, id, infos, spaces: [observations, actions], env_spec, more };
    let mut watcher = Watcher::new(progress);
    let done = py.detach(|| {
        let trace = TraceReader::open(&source)?;
        minari::export(&trace, &target, &mut |done, total| watcher.report(done, total))
    });
    done.map(report).map_err(|error| watcher.explain(error))
}

/// The JSON of Gymnasium's `EnvSpec` of an id.
#[pyfunction]
pub fn env_spec(id: &str) -> String {
    minari::env_spec(id, Registry::builtin().spec(id).ok().map(|spec| spec.max_episode_steps))
}
