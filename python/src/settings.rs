//! Keyword arguments and dictionaries of Python to the settings of an environment, which are TOML.

use env::Arguments;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

/// A dictionary as a table of settings. Numbers, strings, lists, tuples, dictionaries, numpy's arrays and numbers, and paths
/// are settings; one that is `None` is left out, so that the registry's holds.
///
/// # Errors
/// A key that is no string, or a value that is no setting: `TypeError`, with the place (`visual_randomization.lights[0]`).
pub fn arguments(settings: &Bound<'_, PyDict>) -> PyResult<Arguments> {
    table(settings)?.try_into().map_err(|error: toml::de::Error| PyValueError::new_err(error.to_string()))
}

/// A dictionary as a table.
///
/// # Errors
/// Those of [`arguments`].
pub fn table(settings: &Bound<'_, PyDict>) -> PyResult<Table> {
    below("", settings)
}

/// A value of a table as Python has it.
pub fn python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::String(text) => text.into_bound_py_any(py),
        Value::Integer(number) => number.into_bound_py_any(py),
        Value::Float(number) => number.into_bound_py_any(py),
        Value::Boolean(flag) => flag.into_bound_py_any(py),
        Value::Datetime(time) => time.to_string().into_bound_py_any(py),
        Value::Array(values) => {
            let values = values.iter().map(|value| python(py, value)).collect::<PyResult<Vec<_>>>()?;
            Ok(PyList::new(py, values)?.into_any())
        }
        Value::Table(table) => {
            let dict = PyDict::new(py);
            table.iter().try_for_each(|(key, value)| dict.set_item(key, python(py, value)?))?;
            Ok(dict.into_any())
        }
    }
}

fn below(place: &str, dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, item) in dict.iter() {
        let Ok(key) = key.cast::<PyString>().map(|key| key.to_string()) else {
            let place = if place.is_empty() { "a setting" } else { place };
            return Err(PyTypeError::new_err(format!(
                "{place}: names of settings are strings, and {} is none",
                key.repr()?
            )));
        };
        let place = if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
        if !item.is_none() {
            table.insert(key, value(&place, &item)?);
        }
    }
    Ok(table)
}

fn value(place: &str, item: &Bound<'_, PyAny>) -> PyResult<Value> {
    if item.is_instance_of::<PyBool>() {
        return item.extract().map(Value::Boolean);
    }
    if item.is_instance_of::<PyInt>() {
        let number = item.extract().map(Value::Integer);
        return number.map_err(|_| PyValueError::new_err(format!("{place}: {item} has more than 64 bits")));
    }
    if item.is_instance_of::<PyFloat>() {
        return item.extract().map(Value::Float);
    }
    if item.is_instance_of::<PyString>() {
        return item.extract().map(Value::String);
    }
    if let Ok(dict) = item.cast::<PyDict>() {
        return below(place, dict).map(Value::Table);
    }
    if item.is_instance_of::<PyList>() || item.is_instance_of::<PyTuple>() {
        let values = item.try_iter()?.enumerate();
        let values: PyResult<_> =
            values.map(|(index, item)| value(&format!("{place}[{index}]"), &item?)).collect();
        return values.map(Value::Array);
    }
    // Numbers and arrays of numpy, then paths.
    for method in ["tolist", "__fspath__"] {
        if item.hasattr(method)? {
            return value(place, &item.call_method0(method)?);
        }
    }
    let kind = item.get_type().name()?;
    Err(PyTypeError::new_err(format!(
        "{place}: a {kind} is no setting; settings are numbers, strings, lists, dictionaries and numpy's arrays"
    )))
}
