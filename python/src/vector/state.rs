//! Images and states of a batch, each key an array of all environments.

use crate::infos::Names;
use crate::vector::infos::{array, objects};
use crate::world::world;
use env::{EnvError, Pixels, VecEnv};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Draws the images of all visual keys without the interpreter's lock: `time`, and under every key one array (environments x
/// shape of the image); with their masks.
///
/// # Errors
/// An environment whose images cannot be drawn.
pub fn visual_dict<'py>(
    py: Python<'py>,
    envs: &mut VecEnv,
    raise: impl Fn(&EnvError) -> PyErr,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    py.detach(|| envs.exteroception().map(|_| ())).map_err(|error| raise(&error))?;
    let seen: Vec<_> = envs.envs().filter_map(|env| env.visuals()).collect();
    let Some(first) = seen.first().filter(|first| !first.images().is_empty()) else { return Ok(dict) };
    let mask = || PyArray1::from_vec(py, vec![true; seen.len()]);
    let times: Vec<_> = seen.iter().map(|seen| seen.time()).collect();
    dict.set_item("time", array(py, &[seen.len(), 1], &times)?)?;
    dict.set_item("_time", mask())?;
    for (index, image) in first.images().iter().enumerate() {
        let shape: Vec<_> = [seen.len()].into_iter().chain(image.shape().iter().copied()).collect();
        let all = seen.iter().map(|seen| seen.images()[index].pixels());
        let (mut bytes, mut numbers) = (Vec::new(), Vec::new());
        for pixels in all {
            match pixels {
                Pixels::Bytes(values) => bytes.extend_from_slice(values),
                Pixels::Numbers(values) => numbers.extend_from_slice(values),
            }
        }
        let batch = match image.pixels() {
            Pixels::Bytes(_) => array(py, &shape, &bytes)?.into_any(),
            Pixels::Numbers(_) => array(py, &shape, &numbers)?.into_any(),
        };
        dict.set_item(image.name(), batch)?;
        dict.set_item(format!("_{}", image.name()), mask())?;
    }
    Ok(dict)
}

/// The states of the environments `ids`, with their masks, under the keys of a single environment.
pub fn states<'py>(
    py: Python<'py>,
    envs: &VecEnv,
    names: &Names,
    ids: &[usize],
) -> PyResult<Bound<'py, PyDict>> {
    let states = ids.iter().filter_map(|&id| envs.env(id));
    let states: Vec<_> = states.map(|env| world(py, env, &names.own)).collect::<PyResult<_>>()?;
    let dict = PyDict::new(py);
    let Some(first) = states.first() else { return Ok(dict) };
    let numpy = py.import("numpy")?;
    for key in first.keys() {
        let parts = PyList::empty(py);
        for state in &states {
            parts.append(state.get_item(&key)?)?;
        }
        let batch = if parts.get_item(0)?.is_none() {
            objects(py, ids.iter().map(|_| None::<()>))?
        } else {
            numpy.call_method1("stack", (parts,))?
        };
        dict.set_item(format!("_{key}"), PyArray1::from_vec(py, vec![true; ids.len()]))?;
        dict.set_item(key, batch)?;
    }
    Ok(dict)
}
