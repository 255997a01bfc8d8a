//! Recordings in RoboHive's and RoboSet's layouts.

use super::array::{Given, give, take_named};
use super::failure::{data_error, require};
use dataset::trace::{Layout, Precision, Recorder, Target, TraceReader, convert, repair};
use exchange::Episode;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::path::PathBuf;
use std::sync::Mutex;

/// A recording that is read.
#[pyclass(frozen, module = "robohive._core")]
pub struct Trace {
    reader: Mutex<TraceReader>,
}

impl Trace {
    /// Runs work on the file without the interpreter's lock.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&TraceReader) -> Result<T, dataset::trace::TraceError> + Send,
    ) -> PyResult<T> {
        py.detach(|| {
            let reader = self.reader.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            work(&reader)
        })
        .map_err(data_error)
    }
}

#[pymethods]
impl Trace {
    /// Opens an HDF5 file or a numpy archive.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        require(&path)?;
        let reader = py.detach(|| TraceReader::open(&path)).map_err(data_error)?;
        Ok(Trace { reader: Mutex::new(reader) })
    }

    /// Names of the trials, in the order of their numbers.
    fn trials(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |reader| Ok(reader.trials().to_vec()))
    }

    /// Texts that describe the file.
    fn attributes(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        self.with(py, TraceReader::attributes)
    }

    /// Integers that are attributes of a trial's group.
    fn integers(&self, py: Python<'_>, trial: &str) -> PyResult<Vec<(String, i64)>> {
        self.with(py, |reader| reader.integers(trial))
    }

    /// The layout of a trial.
    fn layout(&self, py: Python<'_>, trial: &str) -> PyResult<Option<&'static str>> {
        self.with(py, |reader| Ok(reader.layout(trial)?.map(Layout::name)))
    }

    /// Names of the datasets of a trial, sorted; with the names of their types, and their shapes.
    fn entries(&self, py: Python<'_>, trial: &str) -> PyResult<Vec<(String, String, Vec<usize>)>> {
        let entries = self.with(py, |reader| reader.entries(trial))?;
        Ok(entries.into_iter().map(|e| (e.key, e.kind.name().to_owned(), e.shape)).collect())
    }

    /// Rows of a dataset, all if nothing is said.
    #[pyo3(signature = (trial, key, rows=None))]
    fn read<'py>(
        &self,
        py: Python<'py>,
        trial: &str,
        key: &str,
        rows: Option<(usize, usize)>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let array = self.with(py, |reader| {
            let entry = reader.entry(trial, key)?;
            match rows {
                Some((start, end)) => reader.rows(&entry, start..end),
                None => reader.read(&entry),
            }
        })?;
        give(py, &array)
    }

    /// The texts of a dataset, row-major.
    fn texts(&self, py: Python<'_>, trial: &str, key: &str) -> PyResult<Vec<String>> {
        self.with(py, |reader| reader.texts(&reader.entry(trial, key)?))
    }

    /// The transitions of a trial: names and arrays, infos after them under infos/; the times of states; the seed; what is
    /// not in there, and why.
    fn episode<'py>(&self, py: Python<'py>, trial: &str) -> PyResult<Bound<'py, PyDict>> {
        let episode = self.with(py, |reader| Episode::of_trial(reader, trial))?;
        let out = PyDict::new(py);
        let parts = [
            ("observations", &episode.observations),
            ("actions", &episode.actions),
            ("rewards", &episode.rewards),
            ("terminations", &episode.terminations),
            ("truncations", &episode.truncations),
        ];
        for (name, array) in parts {
            out.set_item(name, give(py, array)?)?;
        }
        let infos = PyDict::new(py);
        for (name, array) in &episode.infos {
            infos.set_item(name, give(py, array)?)?;
        }
        out.set_item("infos", infos)?;
        out.set_item("times", episode.times)?;
        out.set_item("seed", episode.seed)?;
        out.set_item("dropped", episode.dropped)?;
        Ok(out)
    }
}

fn layout_of(name: &str) -> PyResult<Layout> {
    match name {
        "robohive" => Ok(Layout::RoboHive),
        "roboset" => Ok(Layout::RoboSet),
        other => Err(PyValueError::new_err(format!("no layout {other:?}: \"robohive\" or \"roboset\""))),
    }
}

fn precision_of(name: &str) -> PyResult<Precision> {
    match name {
        "full" => Ok(Precision::Full),
        "reduced" => Ok(Precision::Reduced),
        other => Err(PyValueError::new_err(format!("no precision {other:?}: \"full\" or \"reduced\""))),
    }
}

/// A recording that is being written.
#[pyclass(frozen, module = "robohive._core")]
pub struct TraceWriter {
    recorder: Mutex<Option<Recorder>>,
}

#[pymethods]
impl TraceWriter {
    /// Makes a recording, or goes on with one.
    #[new]
    fn new(
        path: PathBuf,
        layout: &str,
        precision: &str,
        attributes: Vec<(String, String)>,
        append: bool,
    ) -> PyResult<Self> {
        let (layout, precision) = (layout_of(layout)?, precision_of(precision)?);
        let attributes: Vec<(&str, &str)> = attributes.iter().map(|(a, b)| (&a[..], &b[..])).collect();
        let recorder = if append {
            require(&path)?;
            Recorder::append(&path, layout, precision)
        } else {
            Recorder::create_with(&path, layout, precision, &attributes)
        };
        Ok(TraceWriter { recorder: Mutex::new(Some(recorder.map_err(data_error)?)) })
    }

    /// Writes a trial: rows, datasets without rows, and texts. When this returns the file holds it.
    fn write(
        &self,
        py: Python<'_>,
        name: &str,
        rows: Vec<(String, Given)>,
        values: Vec<(String, Given)>,
        texts: Vec<(String, Vec<usize>, Vec<String>)>,
    ) -> PyResult<()> {
        let (rows, values) = (take_named(rows)?, take_named(values)?);
        let mut recorder = self.recorder.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let recorder = recorder.as_mut().ok_or_else(closed)?;
        py.detach(|| {
            let mut trial = recorder.begin(name)?;
            rows.iter().try_for_each(|(key, array)| trial.push_rows(key, array))?;
            values.iter().try_for_each(|(key, array)| trial.set(key, array))?;
            texts.iter().try_for_each(|(key, shape, texts)| trial.set_text(key, shape, texts))?;
            trial.finish()
        })
        .map_err(data_error)
    }

    /// Names of rows that had no place in the layout.
    fn unmapped(&self) -> PyResult<Vec<String>> {
        let recorder = self.recorder.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        Ok(recorder.as_ref().ok_or_else(closed)?.unmapped().map(str::to_owned).collect())
    }

    /// Completes the file.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let recorder = self.recorder.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
        py.detach(|| recorder.map_or(Ok(()), Recorder::close)).map_err(data_error)
    }
}

/// What is raised for the use of a writer after its end.
pub fn closed() -> PyErr {
    PyValueError::new_err("the writer is closed")
}

/// Writes a recording in another layout, format or precision: its trials, and what has no place in the output, and why.
#[pyfunction]
pub fn convert_trace(
    py: Python<'_>,
    source: PathBuf,
    target: PathBuf,
    layout: Option<&str>,
    precision: &str,
) -> PyResult<(usize, Vec<(String, String)>)> {
    require(&source)?;
    let wanted = Target { layout: layout.map(layout_of).transpose()?, precision: precision_of(precision)? };
    let done = py.detach(|| {
        let converted = TraceReader::open(&source).and_then(|trace| convert(&trace, &target, wanted));
        converted.inspect_err(|_| {
            // Half a recording would look like a whole one.
            _ = std::fs::remove_file(&target);
        })
    });
    let done = done.map_err(data_error)?;
    Ok((done.trials, done.dropped))
}

/// Saves what is readable of a damaged recording.
#[pyfunction]
pub fn repair_trace<'py>(py: Python<'py>, source: PathBuf, target: PathBuf) -> PyResult<Bound<'py, PyDict>> {
    require(&source)?;
    if source.canonicalize().is_ok_and(|a| target.canonicalize().is_ok_and(|b| a == b)) {
        return Err(PyValueError::new_err("the repaired recording is written to another file"));
    }
    let report = py.detach(|| repair(&source, &target)).map_err(data_error)?;
    let out = PyDict::new(py);
    out.set_item("saved", report.saved)?;
    out.set_item("lost", report.lost)?;
    out.set_item("dropped", report.dropped)?;
    out.set_item("damage", report.damage)?;
    out.set_item("unused", report.unused)?;
    Ok(out)
}
