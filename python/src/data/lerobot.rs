//! Datasets of LeRobot.

use super::array::{Given, give_bytes, take_named};
use super::failure::{Watcher, data_error, require, vacant};
use super::minari::{Report, report};
use super::trace::closed;
use dataset::Dtype;
use dataset::trace::TraceReader;
use exchange::lerobot::{self, Cells, Column, Frames, LeRobotReader, Pictures, Settings, Target};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use std::path::PathBuf;
use std::sync::Mutex;

fn pictures_of(name: &str) -> PyResult<Pictures> {
    match name {
        "video" => Ok(Pictures::Video),
        "png" => Ok(Pictures::Png),
        other => Err(PyValueError::new_err(format!("no form of pictures {other:?}: \"video\" or \"png\""))),
    }
}

/// A dataset that is being written.
#[pyclass(frozen, module = "robohive._core")]
pub struct LeRobotWriter {
    writer: Mutex<Option<lerobot::LeRobotWriter>>,
}

#[pymethods]
impl LeRobotWriter {
    /// Begins a dataset.
    #[new]
    fn new(root: PathBuf, fps: f64, robot: Option<String>, pictures: &str) -> PyResult<Self> {
        let settings = Settings::new(fps).with_robot(robot).with_pictures(pictures_of(pictures)?);
        vacant(&root, "the folder")?;
        let writer = lerobot::LeRobotWriter::create(&root, settings).map_err(data_error)?;
        Ok(LeRobotWriter { writer: Mutex::new(Some(writer)) })
    }

    /// Adds an episode.
    fn add(&self, py: Python<'_>, columns: Vec<(String, Given)>, task: String) -> PyResult<()> {
        let frames = Frames { features: take_named(columns)?, task };
        let mut writer = self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let writer = writer.as_mut().ok_or_else(closed)?;
        py.detach(|| writer.add(&frames)).map_err(data_error)
    }

    /// Completes the dataset and gives it its name.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        let writer = self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
        let writer = writer.ok_or_else(closed)?;
        py.detach(|| writer.finish()).map_err(data_error)
    }

    /// Removes what was written.
    fn discard(&self) {
        drop(self.writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take());
    }
}

/// A dataset that is read.
#[pyclass(frozen, module = "robohive._core")]
pub struct LeRobotFrames {
    reader: LeRobotReader,
}

#[pymethods]
impl LeRobotFrames {
    /// Opens the dataset in a folder.
    #[new]
    fn new(py: Python<'_>, root: PathBuf) -> PyResult<Self> {
        require(&root)?;
        let reader = py.detach(|| LeRobotReader::open(&root)).map_err(data_error)?;
        Ok(LeRobotFrames { reader })
    }

    /// What `meta/info.json` says, as JSON.
    fn info(&self) -> String {
        self.reader.info().to_string()
    }

    /// Number of episodes.
    fn episodes(&self) -> usize {
        self.reader.episodes()
    }

    /// The text of a task.
    fn task(&self, index: i64) -> Option<&str> {
        self.reader.task(index)
    }

    /// The frames of an episode: names with arrays, or with lists of the bytes of PNG files.
    fn read<'py>(&self, py: Python<'py>, episode: usize) -> PyResult<Bound<'py, PyDict>> {
        if episode >= self.reader.episodes() {
            let message = format!("no episode {episode}: the dataset has {}", self.reader.episodes());
            return Err(PyIndexError::new_err(message));
        }
        let columns = py.detach(|| self.reader.read(episode)).map_err(data_error)?;
        let out = PyDict::new(py);
        for column in columns {
            out.set_item(&column.name, cells(py, &column)?)?;
        }
        Ok(out)
    }
}

/// The values of a column, for Python.
fn cells<'py>(py: Python<'py>, column: &Column) -> PyResult<Bound<'py, PyAny>> {
    let rows = column.cells.len() / column.row.iter().product::<usize>().max(1);
    let shape = [&[rows], &column.row[..]].concat();
    let give = |dtype, bytes: Vec<u8>| give_bytes(py, dtype, &shape, &bytes).map(Bound::into_any);
    match &column.cells {
        Cells::F32(v) => give(Dtype::F32, v.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Cells::F64(v) => give(Dtype::F64, v.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Cells::I64(v) => give(Dtype::I64, v.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Cells::Bool(v) => give(Dtype::Bool, v.iter().map(|&x| u8::from(x)).collect()),
        Cells::Text(v) => Ok(PyList::new(py, v)?.into_any()),
        Cells::Png(v) => Ok(PyList::new(py, v.iter().map(|file| PyBytes::new(py, file)))?.into_any()),
    }
}

/// Makes a dataset of a recording.
#[pyfunction]
pub fn export_lerobot(
    py: Python<'_>,
    source: PathBuf,
    root: PathBuf,
    about: (Option<String>, Option<String>, Option<f64>),
    pictures: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<Report> {
    require(&source)?;
    vacant(&root, "the folder")?;
    let (task, robot, frames_per_second) = about;
    let target = Target { root, task, robot, frames_per_second, pictures: pictures_of(pictures)? };
    let mut watcher = Watcher::new(progress);
    let done = py.detach(|| {
        let trace = TraceReader::open(&source)?;
        lerobot::export(&trace, &target, &mut |done, total| watcher.report(done, total))
    });
    done.map(report).map_err(|error| watcher.explain(error))
}
