//! Arrays of a model and of a simulation under MuJoCo's names, as numpy's.

use crate::infos::shaped;
use env::Scene;
use physics::table::Slice;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The array `name` of the model (`of` is `model`) or of the simulation (`data`), as a copy; `None` where there is none.
///
/// # Errors
/// `of` is neither.
pub fn named<'py>(
    py: Python<'py>,
    scene: &Scene,
    of: &str,
    name: &str,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let mut found = None;
    let mut take = |given: &'static str, shape: Vec<usize>, values: Slice<'_>| {
        if given == name {
            found = Some(array(py, &shape, values));
        }
    };
    match of {
        "model" => scene.model.visit(&mut take),
        "data" => scene.data.visit(&scene.model, &mut take),
        _ => return Err(PyValueError::new_err(format!("arrays are of model or data, not of {of}"))),
    }
    found.transpose()
}

fn array<'py>(py: Python<'py>, shape: &[usize], values: Slice<'_>) -> PyResult<Bound<'py, PyAny>> {
    Ok(match values {
        Slice::Bool(values) => shaped(py, shape, values)?.into_any(),
        Slice::U8(values) => shaped(py, shape, values)?.into_any(),
        Slice::I32(values) => shaped(py, shape, values)?.into_any(),
        Slice::I64(values) => shaped(py, shape, values)?.into_any(),
        Slice::F32(values) => shaped(py, shape, values)?.into_any(),
        Slice::F64(values) => shaped(py, shape, values)?.into_any(),
    })
}
