//! Fresh numpy arrays of what the engine holds.

use numpy::{PyArray1, PyArrayMethods};
use physics::table::Slice;
use pyo3::prelude::*;

/// A fresh numpy array of these scalars.
pub fn array<'py>(py: Python<'py>, slice: Slice<'_>, shape: Vec<usize>) -> PyResult<Bound<'py, PyAny>> {
    Ok(match slice {
        Slice::Bool(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
        Slice::U8(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
        Slice::I32(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
        Slice::I64(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
        Slice::F32(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
        Slice::F64(s) => PyArray1::from_slice(py, s).reshape(shape)?.into_any(),
    })
}
