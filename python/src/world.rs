//! The state of an environment as RoboHive's dictionary, in both directions.

use crate::own_state::OwnState;
use env::{Env, WorldState};
use numpy::ndarray::ArrayView2;
use numpy::{PyArray1, PyArray2, PyReadonlyArrayDyn};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// `get_env_state`: time [s], positions, velocities, activations, mocap bodies, and where sites and bodies stand in their
/// parents; `None` for what the model does not have. Four tasks have keys of their own as well ([`OwnState`]).
pub fn world<'py>(py: Python<'py>, env: &Env, own: &OwnState) -> PyResult<Bound<'py, PyDict>> {
    let (model, state) = (&env.scene().model, &env.scene().data.state);
    let dict = PyDict::new(py);
    let flat = |values: &[f64]| (!values.is_empty()).then(|| PyArray1::from_slice(py, values));
    dict.set_item(intern!(py, "time"), state.time)?;
    dict.set_item(intern!(py, "qpos"), flat(&state.qpos))?;
    dict.set_item(intern!(py, "qvel"), flat(&state.qvel))?;
    dict.set_item(intern!(py, "act"), flat(&state.act))?;
    dict.set_item(intern!(py, "mocap_pos"), rows(py, &state.mocap_pos))?;
    dict.set_item(intern!(py, "mocap_quat"), rows(py, &state.mocap_quat))?;
    dict.set_item(intern!(py, "site_pos"), rows(py, &model.site_pos))?;
    dict.set_item(intern!(py, "site_quat"), rows(py, &model.site_quat))?;
    dict.set_item(intern!(py, "body_pos"), rows(py, &model.body_pos))?;
    dict.set_item(intern!(py, "body_quat"), rows(py, &model.body_quat))?;
    own.show(py, env.scene(), &dict)?;
    Ok(dict)
}

/// Reads what [`world`] writes, for [`Env::set_world`]; keys may be missing or `None`.
///
/// # Errors
/// A key that no state has: `KeyError`; values that are no numbers, or not finite: `ValueError`.
pub fn read(env: &Env, own: &OwnState, dict: &Bound<'_, PyDict>) -> PyResult<WorldState> {
    let mut world = WorldState::default();
    let mut derived = Vec::new();
    for (key, item) in dict.iter() {
        let key: String = key.extract()?;
        if item.is_none() {
            continue;
        }
        let values = numbers(&item)?;
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("value {index} of {key} is {}; states are finite numbers", values[index]);
            return Err(PyValueError::new_err(message));
        }
        if !world.set(&key, &values) {
            derived.push((key, values));
        }
    }
    // After the arrays of all bodies and sites, which hold what these keys say.
    for (key, values) in &derived {
        if !own.read(dict.py(), env.scene(), (key, values), &mut world)? {
            let names = WorldState::NAMES.join(", ");
            return Err(PyKeyError::new_err(format!("no state has a part {key}; there are {names}")));
        }
    }
    Ok(world)
}

fn numbers(item: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = numpy::get_array_module(item.py())?.call_method1("asarray", (item, "float64"))?;
    let array: PyReadonlyArrayDyn<'_, f64> = array.extract()?;
    Ok(array.as_array().iter().copied().collect())
}

fn rows<'py, const N: usize>(py: Python<'py>, rows: &[[f64; N]]) -> Option<Bound<'py, PyArray2<f64>>> {
    let view = ArrayView2::from_shape((rows.len(), N), rows.as_flattened()).ok()?;
    (!rows.is_empty()).then(|| PyArray2::from_array(py, &view))
}
