//! What an environment tells beside its observation, as RoboHive's dictionaries of numpy arrays.
//!
//! Every array is a copy, made for the call. Rows of one value are arrays without axes, as RoboHive squeezes them; the
//! proprioception's keep their axis, as its do.

use crate::own_state::OwnState;
use crate::world::world;
use env::{Env, Exteroception, Pixels, Rows};
use numpy::ndarray::{ArrayViewD, IxDyn, aview0};
use numpy::{PyArray0, PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use pyo3::{Borrowed, intern};
use std::ops::Range;

/// The names of an environment's rows, as strings of Python that are made once.
pub struct Names {
    rows: Vec<Py<PyString>>,
    terms: Vec<Py<PyString>>,
    /// Which rows the proprioception has, time among them, and where their values stand; `None` where the task has none.
    proprio: Option<Vec<(usize, Range<usize>)>>,
    /// Keys of the task's own in its states.
    pub own: OwnState,
}

impl Names {
    /// Those of `env`; they do not change after it was made.
    pub fn of(py: Python<'_>, env: &Env) -> Self {
        let names =
            |rows: &Rows| rows.rows().iter().map(|row| PyString::intern(py, row.name()).unbind()).collect();
        let proprio = env.proprio_keys().map(|keys| {
            let wanted = |name: &str| name == "time" || keys.iter().any(|key| key == name);
            let rows = env.rows().rows().iter().enumerate();
            let rows = rows.filter(|(_, row)| wanted(row.name()));
            rows.filter_map(|(index, row)| Some((index, env.rows().place(row.name())?))).collect()
        });
        let own = OwnState::of(py, &env.spec().task, env.scene());
        Names { rows: names(env.rows()), terms: names(env.terms()), proprio, own }
    }

    /// `obs_dict`: every row of the observation dictionary by its name.
    pub fn obs_dict<'py>(&self, py: Python<'py>, env: &Env) -> PyResult<Bound<'py, PyDict>> {
        rows(py, &self.rows, env.rows())
    }

    /// `rwd_dict`: every term of the reward by its name, and `sparse`, `solved`, `done` and `dense`.
    pub fn rwd_dict<'py>(&self, py: Python<'py>, env: &Env) -> PyResult<Bound<'py, PyDict>> {
        let dict = rows(py, &self.terms, env.terms())?;
        let verdict = env.verdict();
        dict.set_item(intern!(py, "sparse"), number(py, verdict.sparse))?;
        dict.set_item(intern!(py, "solved"), flag(py, verdict.solved))?;
        dict.set_item(intern!(py, "done"), flag(py, verdict.done))?;
        dict.set_item(intern!(py, "dense"), number(py, env.dense()))?;
        Ok(dict)
    }

    /// `proprio_dict`: `time` and the rows of the proprioception; `None` where the task has none.
    pub fn proprio_dict<'py>(&self, py: Python<'py>, env: &Env) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(proprio) = &self.proprio else { return Ok(None) };
        let dict = PyDict::new(py);
        for (index, place) in proprio {
            let values = &env.rows().values()[place.clone()];
            dict.set_item(&self.rows[*index], PyArray1::from_slice(py, values))?;
        }
        Ok(Some(dict))
    }

    /// What a step returns last: `time`, `rwd_dense`, `rwd_sparse`, `solved`, `done`, and the dictionaries `obs_dict`,
    /// `visual_dict` (empty unless images were taken of this state), `proprio_dict`, `rwd_dict` and `state`.
    pub fn infos<'py>(&self, py: Python<'py>, env: &Env) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        let verdict = env.verdict();
        dict.set_item(intern!(py, "time"), env.scene().data.time())?;
        dict.set_item(intern!(py, "rwd_dense"), env.dense())?;
        dict.set_item(intern!(py, "rwd_sparse"), verdict.sparse)?;
        dict.set_item(intern!(py, "solved"), verdict.solved)?;
        dict.set_item(intern!(py, "done"), verdict.done)?;
        dict.set_item(intern!(py, "obs_dict"), self.obs_dict(py, env)?)?;
        let visuals = env.visuals().map_or_else(|| Ok(PyDict::new(py)), |seen| visual_dict(py, seen))?;
        dict.set_item(intern!(py, "visual_dict"), visuals)?;
        dict.set_item(intern!(py, "proprio_dict"), self.proprio_dict(py, env)?)?;
        dict.set_item(intern!(py, "rwd_dict"), self.rwd_dict(py, env)?)?;
        dict.set_item(intern!(py, "state"), world(py, env, &self.own)?)?;
        Ok(dict)
    }
}

/// `visual_dict`: `time`, and the image of every visual key: bytes of colours, or 32-bit depths [m] and features.
pub fn visual_dict<'py>(py: Python<'py>, seen: &Exteroception) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    if seen.images().is_empty() {
        return Ok(dict);
    }
    dict.set_item(intern!(py, "time"), PyArray1::from_slice(py, &[seen.time()]))?;
    for image in seen.images() {
        match image.pixels() {
            Pixels::Bytes(bytes) => dict.set_item(image.name(), shaped(py, image.shape(), bytes)?)?,
            Pixels::Numbers(numbers) => dict.set_item(image.name(), shaped(py, image.shape(), numbers)?)?,
        }
    }
    Ok(dict)
}

/// A new array of this shape with these values.
///
/// # Errors
/// The shape holds another number of values.
pub fn shaped<'py, T: numpy::Element>(
    py: Python<'py>,
    shape: &[usize],
    values: &[T],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let view = ArrayViewD::from_shape(IxDyn(shape), values)
        .map_err(|error| pyo3::exceptions::PyValueError::new_err(error.to_string()))?;
    Ok(PyArrayDyn::from_array(py, &view))
}

fn rows<'py>(py: Python<'py>, names: &[Py<PyString>], rows: &Rows) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, (_, values)) in names.iter().zip(rows.iter()) {
        let name: Borrowed<'_, '_, PyString> = name.bind_borrowed(py);
        match values {
            [value] => dict.set_item(name, number(py, *value))?,
            _ => dict.set_item(name, PyArray1::from_slice(py, values))?,
        }
    }
    Ok(dict)
}

fn number(py: Python<'_>, value: f64) -> Bound<'_, PyArray0<f64>> {
    PyArray0::from_array(py, &aview0(&value))
}

fn flag(py: Python<'_>, value: bool) -> Bound<'_, PyArray0<bool>> {
    PyArray0::from_array(py, &aview0(&value))
}
