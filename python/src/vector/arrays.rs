//! Batches of actions from Python, and arrays for batches of observations, in 32 or 64 bits.

use numpy::ndarray::Dim;
use numpy::{
    Element, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadwriteArray2, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Rows of numbers of Python's, read in place.
pub enum Actions<'py> {
    /// 32 bits, as the spaces of actions have them.
    Narrow(PyReadonlyArray2<'py, f32>),
    /// 64 bits.
    Wide(PyReadonlyArray2<'py, f64>),
}

/// Rows of numbers, without Python.
#[derive(Clone, Copy)]
pub enum Numbers<'a> {
    Narrow(&'a [f32]),
    Wide(&'a [f64]),
}

impl<'py> Actions<'py> {
    /// Actions of `count` environments, `width` values each: an array of two axes, or anything that numpy makes one of.
    ///
    /// # Errors
    /// Another shape: `ValueError`; no numbers: `TypeError`.
    pub fn read(actions: &Bound<'py, PyAny>, count: usize, width: usize) -> PyResult<Self> {
        let read = Self::in_place(actions).map_or_else(|| Self::converted(actions), Ok)?;
        let shape = match &read {
            Actions::Narrow(array) => array.dims(),
            Actions::Wide(array) => array.dims(),
        };
        if shape == Dim([count, width]) {
            return Ok(read);
        }
        Err(PyValueError::new_err(format!(
            "actions have shape ({count}, {width}) here, and ({}, {}) was given",
            shape[0], shape[1]
        )))
    }

    /// The numbers, row after row.
    pub fn numbers(&self) -> PyResult<Numbers<'_>> {
        Ok(match self {
            Actions::Narrow(array) => Numbers::Narrow(array.as_slice()?),
            Actions::Wide(array) => Numbers::Wide(array.as_slice()?),
        })
    }

    fn in_place(actions: &Bound<'py, PyAny>) -> Option<Self> {
        if let Ok(array) = actions.extract::<PyReadonlyArray2<'py, f32>>() {
            return array.is_c_contiguous().then_some(Actions::Narrow(array));
        }
        let array = actions.extract::<PyReadonlyArray2<'py, f64>>().ok()?;
        array.is_c_contiguous().then_some(Actions::Wide(array))
    }

    fn converted(actions: &Bound<'py, PyAny>) -> PyResult<Self> {
        let numpy = actions.py().import("numpy")?;
        let array = numpy.call_method1("asarray", (actions,))?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        // Booleans and integers are numbers; strings, objects and complex numbers are not.
        if !"fiub".contains(&kind) {
            let found = array.getattr("dtype")?;
            return Err(PyTypeError::new_err(format!("actions are an array of numbers, not of {found}")));
        }
        let array = numpy.call_method1("ascontiguousarray", (array, "float64"))?;
        let axes = array.cast::<PyUntypedArray>()?.ndim();
        let wrong = |_| {
            PyValueError::new_err(format!("actions have two axes, one row for each environment, not {axes}"))
        };
        array.extract().map(Actions::Wide).map_err(wrong)
    }
}

/// An array of observations that is being written.
pub enum Rows<'py> {
    Narrow(PyReadwriteArray2<'py, f32>),
    Wide(PyReadwriteArray2<'py, f64>),
}

/// Numbers to be written, without Python.
pub enum NumbersMut<'a> {
    Narrow(&'a mut [f32]),
    Wide(&'a mut [f64]),
}

impl<'py> Rows<'py> {
    /// A new array of this shape.
    pub fn new(py: Python<'py>, narrow: bool, shape: [usize; 2]) -> PyResult<Self> {
        Ok(if narrow {
            Rows::Narrow(PyArray2::zeros(py, shape, false).try_readwrite()?)
        } else {
            Rows::Wide(PyArray2::zeros(py, shape, false).try_readwrite()?)
        })
    }

    /// The caller's array, which must have this shape and precision.
    ///
    /// # Errors
    /// It has not, cannot be written, or is not contiguous: `ValueError`; it is no such array: `TypeError`.
    pub fn of(out: &Bound<'py, PyAny>, narrow: bool, shape: [usize; 2]) -> PyResult<Self> {
        Ok(if narrow {
            Rows::Narrow(writable(out, shape, "float32")?)
        } else {
            Rows::Wide(writable(out, shape, "float64")?)
        })
    }

    /// The numbers, row after row.
    pub fn numbers(&mut self) -> PyResult<NumbersMut<'_>> {
        Ok(match self {
            Rows::Narrow(array) => NumbersMut::Narrow(array.as_slice_mut()?),
            Rows::Wide(array) => NumbersMut::Wide(array.as_slice_mut()?),
        })
    }

    /// The array, as Python has it.
    pub fn into_array(self) -> Bound<'py, PyAny> {
        match self {
            Rows::Narrow(array) => array.as_any().clone(),
            Rows::Wide(array) => array.as_any().clone(),
        }
    }
}

fn writable<'py, T: Element>(
    out: &Bound<'py, PyAny>,
    shape: [usize; 2],
    name: &str,
) -> PyResult<PyReadwriteArray2<'py, T>> {
    let [count, width] = shape;
    let Ok(array) = out.cast::<PyArray2<T>>() else {
        let kind = out.get_type().name()?;
        return Err(PyTypeError::new_err(format!(
            "out is an array of {name} with shape ({count}, {width}), not this {kind}"
        )));
    };
    if array.dims() != Dim(shape) || !array.is_c_contiguous() {
        let found = array.dims();
        return Err(PyValueError::new_err(format!(
            "out is a contiguous array of shape ({count}, {width}), and has shape ({}, {})",
            found[0], found[1]
        )));
    }
    array.try_readwrite().map_err(|error| PyValueError::new_err(format!("out cannot be written: {error}")))
}
