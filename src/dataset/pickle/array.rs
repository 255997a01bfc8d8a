//! Numpy arrays and scalars in pickles.

use super::error::PickleError;
use super::value::Value;
use crate::npy::{Array, Dtype, MAX_SCALARS, Values};

/// Modules that numpy has kept its array type in.
const MODULES: [&str; 2] = ["numpy.core.multiarray", "numpy._core.multiarray"];

impl Value<'_> {
    /// A numpy array of numbers, in double precision.
    ///
    /// # Errors
    /// The value is no array, of a type or order that is not read, or inconsistent.
    pub fn array(self) -> Result<Array, PickleError> {
        let wrong = |message: &str| PickleError::content(format!("a numpy array: {message}"));
        if !MODULES.iter().any(|module| self.call(module, "_reconstruct").is_some()) {
            return Err(wrong(&format!("{} is something else", self.kind())));
        }
        // Version, shape, type, whether columns come first, and the numbers.
        let state = self.state().ok_or_else(|| wrong("it has no state"))?;
        let part = |k| state.item(k).ok_or_else(|| wrong("its state is not that of an array"));
        let shape: Option<Vec<usize>> = part(1)?.items().map(Value::count).collect();
        let shape = shape.ok_or_else(|| wrong("its shape is no tuple of lengths"))?;
        if part(3)?.bool() == Some(true) && shape.len() > 1 {
            return Err(wrong("its numbers stand in Fortran order, which is not read"));
        }
        let count = scalars(&shape).ok_or_else(|| wrong("its shape is too large"))?;
        let bytes = part(4)?.bytes().ok_or_else(|| wrong("it holds objects, not numbers"))?;
        let values = decode(part(2)?, bytes).map_err(|message| wrong(&message))?;
        if values.len() != count {
            return Err(wrong(&format!("{} numbers do not fill its shape {shape:?}", values.len())));
        }
        Ok(Array::f64(shape, values))
    }
}

/// How many numbers a shape has, if not too many.
pub(super) fn scalars(shape: &[usize]) -> Option<usize> {
    let count = shape.iter().try_fold(1usize, |count, &axis| count.checked_mul(axis));
    count.filter(|&count| count <= MAX_SCALARS)
}

/// Numbers of the type that `dtype` describes.
fn decode(dtype: Value<'_>, bytes: &[u8]) -> Result<Vec<f64>, String> {
    let name = dtype.call("numpy", "dtype").and_then(|arguments| arguments.item(0)?.text());
    let big = dtype.state().and_then(|state| state.item(1)?.text()) == Some(">");
    let dtype = match name {
        _ if big => return Err("its numbers are big-endian, which is not read".into()),
        Some("f8") => Dtype::F64,
        Some("f4") => Dtype::F32,
        Some("i8") => Dtype::I64,
        Some("i4") => Dtype::I32,
        Some("b1") => Dtype::Bool,
        Some(other) => return Err(format!("its type {other} is not read; f8, f4, i8, i4 and b1 are")),
        None => return Err("its type is not described".into()),
    };
    if !bytes.len().is_multiple_of(dtype.bytes()) {
        return Err("its last number is cut off".into());
    }
    Ok(Values::from_bytes(dtype, bytes).to_f64())
}
