//! Arrays of a model and of a simulation under MuJoCo's names, as numpy's.

use crate::infos::shaped;
use env::Scene;
use physics::model::ObjType;
use physics::table::Slice;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The array or size `name` of the model (`of` is `model`), the array of the simulation (`data`), or the simulation option
/// (`option`), as a copy; `None` if there is none.
///
/// # Errors
/// `of` is none of these.
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
        "option" => scene.model.opt.visit(&mut |given, values| take(given, vec![values.len()], values)),
        _ => {
            let message = format!("arrays are of model, data or option, not of {of}");
            return Err(PyValueError::new_err(message));
        }
    }
    if found.is_none() && of == "model" {
        scene.model.visit_sizes(&mut |given, size| {
            if given == name {
                found = Some(size.into_bound_py_any(py));
            }
        });
    }
    found.transpose()
}

/// The number of an element of a kind (`body`, `site` …) by its name.
///
/// # Errors
/// There is no such kind, or no such element: `ValueError`, as in RoboHive.
pub fn element(scene: &Scene, kind: &str, name: &str) -> PyResult<usize> {
    let element = match kind {
        "body" => ObjType::Body,
        "joint" => ObjType::Joint,
        "geom" => ObjType::Geom,
        "site" => ObjType::Site,
        "camera" => ObjType::Camera,
        "actuator" => ObjType::Actuator,
        "sensor" => ObjType::Sensor,
        "tendon" => ObjType::Tendon,
        _ => return Err(PyValueError::new_err(format!("no elements are called {kind}"))),
    };
    let missing = || PyValueError::new_err(format!("the model has no {kind} named {name}"));
    scene.model.id_of(element, name).ok_or_else(missing)
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
