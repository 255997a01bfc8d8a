//! Arrays on their way from and to numpy.

use dataset::{Array, Dtype, Values};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyTuple};

/// Dtype, shape and bytes of an array, as Python gives them.
pub type Given = (String, Vec<usize>, Vec<u8>);

/// The array of what Python gave.
pub fn take((dtype, shape, bytes): Given) -> PyResult<Array> {
    let dtype = Dtype::ALL.into_iter().find(|known| known.name() == dtype).ok_or_else(|| {
        let names: Vec<_> = Dtype::ALL.iter().map(|dtype| dtype.name()).collect();
        PyTypeError::new_err(format!("dtype {dtype} is not kept: use one of {}", names.join(", ")))
    })?;
    let count = shape.iter().try_fold(dtype.bytes(), |n, &axis| n.checked_mul(axis));
    if count != Some(bytes.len()) {
        return Err(PyTypeError::new_err(format!("{} bytes do not fill shape {shape:?}", bytes.len())));
    }
    Ok(Array { shape, values: Values::from_bytes(dtype, &bytes) })
}

/// Arrays with their names.
pub fn take_named(columns: Vec<(String, Given)>) -> PyResult<Vec<(String, Array)>> {
    columns.into_iter().map(|(name, given)| Ok((name, take(given)?))).collect()
}

/// Dtype, shape and bytes of an array, for Python.
pub fn give<'py>(py: Python<'py>, array: &Array) -> PyResult<Bound<'py, PyTuple>> {
    let mut bytes = Vec::new();
    array.values.put_bytes(&mut bytes);
    give_bytes(py, array.values.dtype(), &array.shape, &bytes)
}

/// Dtype, shape and bytes, for Python; an array that numpy makes of them can be written to.
pub fn give_bytes<'py>(
    py: Python<'py>,
    dtype: Dtype,
    shape: &[usize],
    bytes: &[u8],
) -> PyResult<Bound<'py, PyTuple>> {
    (dtype.name(), PyTuple::new(py, shape)?, PyByteArray::new(py, bytes)).into_pyobject(py)
}
