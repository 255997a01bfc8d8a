//! Actions of Python to numbers.

use numpy::{PyReadonlyArray1, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Reads one action into `values`, whose length it must have: an array of one axis, or anything that numpy makes one of.
///
/// # Errors
/// Another shape: `ValueError`; no numbers: `TypeError`.
pub fn read(action: &Bound<'_, PyAny>, values: &mut [f64]) -> PyResult<()> {
    // Policies give 32 bits: the space of actions has them.
    if let Ok(array) = action.extract::<PyReadonlyArray1<'_, f32>>()
        && let Ok(slice) = array.as_slice()
    {
        let wide = slice.iter().map(|&value| f64::from(value));
        return copy(&[slice.len()], wide, values);
    }
    if let Ok(array) = action.extract::<PyReadonlyArray1<'_, f64>>()
        && let Ok(slice) = array.as_slice()
    {
        return copy(&[slice.len()], slice.iter().copied(), values);
    }
    let array = numpy::get_array_module(action.py())?.call_method1("asarray", (action,))?;
    // Booleans and integers are numbers; strings, objects and complex numbers are not.
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    if !"fiub".contains(&kind) {
        let found = array.getattr("dtype")?;
        return Err(PyTypeError::new_err(format!("an action is an array of numbers, not of {found}")));
    }
    let array = array.call_method1("astype", ("float64",))?;
    let array: PyReadonlyArrayDyn<'_, f64> = array.extract()?;
    copy(array.shape(), array.as_array().iter().copied(), values)
}

fn copy(shape: &[usize], from: impl Iterator<Item = f64>, to: &mut [f64]) -> PyResult<()> {
    if shape != [to.len()] {
        let shape: Vec<_> = shape.iter().map(|size| format!("{size},")).collect();
        let length = to.len();
        let message = format!("an action has shape ({length},) here, and ({}) was given", shape.join(" "));
        return Err(PyValueError::new_err(message));
    }
    to.iter_mut().zip(from).for_each(|(to, from)| *to = from);
    Ok(())
}
