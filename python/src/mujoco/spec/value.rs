//! Attributes of elements as values of Python: numpy arrays of the attribute's own type, texts, numbers.

use mjcf::spec::{Fields, Form, Value};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

/// A value for Python.
pub fn to_python<'py>(py: Python<'py>, value: Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Flag(x) => x.into_pyobject(py)?.to_owned().into_any(),
        Value::Integer(x) => x.into_pyobject(py)?.into_any(),
        Value::Real(x) => x.into_pyobject(py)?.into_any(),
        Value::Integers(x) => PyArray1::from_vec(py, x).into_any(),
        Value::Singles(x) => PyArray1::from_vec(py, x).into_any(),
        Value::Reals(x) => PyArray1::from_vec(py, x).into_any(),
        Value::Letters(x) => PyBytes::new(py, &x).into_any(),
        Value::Text(x) => x.into_pyobject(py)?.into_any(),
        Value::Texts(x) => PyList::new(py, x)?.into_any(),
    })
}

/// The numbers of a one-dimensional array.
fn numbers<T: numpy::Element + Copy>(item: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    let array: PyReadonlyArray1<'_, T> = item.extract()?;
    Ok(array.as_array().iter().copied().collect())
}

fn from_python(item: &Bound<'_, PyAny>, form: Form) -> PyResult<Value> {
    Ok(match form {
        Form::Flag => Value::Flag(item.is_truthy()?),
        Form::Integer | Form::Code(_) => Value::Integer(item.extract()?),
        Form::Real => Value::Real(item.extract()?),
        Form::Integers(_) => Value::Integers(numbers(item)?),
        Form::Singles(_) => Value::Singles(numbers(item)?),
        Form::Reals(_) => Value::Reals(numbers(item)?),
        Form::Letters(_) => Value::Letters(item.extract()?),
        Form::Text => Value::Text(item.extract()?),
        Form::Texts(_) => Value::Texts(item.extract()?),
    })
}

/// All plain attributes of an element by name.
pub fn shown<'py>(py: Python<'py>, element: &dyn Fields) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let mut result = Ok(());
    element.visit(&mut |name, _, value| {
        if result.is_ok() {
            result = to_python(py, value).and_then(|value| all.set_item(name, value));
        }
    });
    result.map(|()| all)
}

/// Overwrites the attributes of an element by those in `values`; others stay.
///
/// # Errors
/// A `ValueError` that names the attribute whose value does not fit.
pub fn take(values: &Bound<'_, PyDict>, element: &mut dyn Fields) -> PyResult<()> {
    let mut wanted = Vec::new();
    element.visit(&mut |name, form, _| wanted.push((name, form)));
    for (name, form) in wanted {
        let Some(item) = values.get_item(name)? else { continue };
        let misfit = || PyValueError::new_err(format!("{item} is no value of '{name}'"));
        let value = from_python(&item, form).map_err(|_| misfit())?;
        if element.assign(name, value) != Some(true) {
            return Err(misfit());
        }
    }
    Ok(())
}

/// An attribute: name, word for its form, name of its enumeration, how many values, and the value.
pub type Outline<'py> = (&'static str, &'static str, &'static str, Option<usize>, Bound<'py, PyAny>);

/// Forms and values of all attributes of an element.
pub fn outline<'py>(py: Python<'py>, element: &dyn Fields) -> PyResult<Vec<Outline<'py>>> {
    let mut all = Ok(Vec::new());
    element.visit(&mut |name, form, value| {
        let (word, code, length) = match form {
            Form::Flag => ("flag", "", None),
            Form::Integer => ("integer", "", None),
            Form::Code(code) => ("code", code, None),
            Form::Real => ("real", "", None),
            Form::Integers(length) => ("integers", "", length),
            Form::Singles(length) => ("singles", "", length),
            Form::Reals(length) => ("reals", "", length),
            Form::Letters(length) => ("letters", "", length),
            Form::Text => ("text", "", None),
            Form::Texts(length) => ("texts", "", length),
        };
        if let Ok(rows) = &mut all {
            match to_python(py, value) {
                Ok(value) => rows.push((name, word, code, length, value)),
                Err(error) => all = Err(error),
            }
        }
    });
    all
}
