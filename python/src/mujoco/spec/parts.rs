//! Attributes that are no plain values: orientations, inertias, paths of tendons, references of tuples, shares in keyframes.

use mjcf::diagnostic::Loc;
use mjcf::spec::{Body, Inertial, KeyPart, Keyed, Orientation, Tendon, Tuple, TupleEntry, Wrap, WrapKind};
use numpy::{PyArray1, PyReadonlyArray1};
use physics::model::ObjType;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Names of the orientations by their codes; 0 is a quaternion.
const WAYS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// Parts of keyframes by their codes.
const PARTS: [KeyPart; 6] =
    [KeyPart::Qpos, KeyPart::Qvel, KeyPart::Mpos, KeyPart::Mquat, KeyPart::Act, KeyPart::Ctrl];

/// A site, geom, joint or pulley of a tendon: which of these, name, side site, coefficient or divisor.
type Step = (u8, String, String, f64);
/// Numbers of an element in a keyframe: which keyframe, which part, the numbers.
pub type Share = (usize, usize, Vec<f64>);

/// The value of an attribute that every element of the kind has.
pub fn required<'py>(values: &Bound<'py, PyDict>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    values.get_item(name)?.ok_or_else(|| PyValueError::new_err(format!("an element lacks '{name}'")))
}

fn fixed<const N: usize>(values: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let array: PyReadonlyArray1<'_, f64> = values.extract()?;
    let numbers: Vec<f64> = array.as_array().iter().copied().collect();
    let length = numbers.len();
    numbers.try_into().map_err(|_| PyValueError::new_err(format!("{N} numbers are needed, not {length}")))
}

/// Code and numbers of an orientation.
pub fn orientation(alt: Option<Orientation>) -> (usize, Vec<f64>) {
    match alt {
        None => (0, Vec::new()),
        Some(Orientation::AxisAngle(x)) => (1, x.to_vec()),
        Some(Orientation::XyAxes(x)) => (2, x.to_vec()),
        Some(Orientation::ZAxis(x)) => (3, x.to_vec()),
        Some(Orientation::Euler(x)) => (4, x.to_vec()),
    }
}

/// The orientation of an `MjsOrientation`.
pub fn take_orientation(values: &Bound<'_, PyDict>, name: &str) -> PyResult<Option<Orientation>> {
    let alt = required(values, name)?;
    let code: usize = alt.getattr("type")?.extract()?;
    let way =
        WAYS.get(code).ok_or_else(|| PyValueError::new_err(format!("no orientation has code {code}")))?;
    let numbers = || alt.getattr(*way);
    Ok(match code {
        0 => None,
        1 => Some(Orientation::AxisAngle(fixed(&numbers()?)?)),
        2 => Some(Orientation::XyAxes(fixed(&numbers()?)?)),
        3 => Some(Orientation::ZAxis(fixed(&numbers()?)?)),
        _ => Some(Orientation::Euler(fixed(&numbers()?)?)),
    })
}

/// Adds the inertia of a body to its attributes; NaN stands for what is not given.
pub fn show_inertial(py: Python<'_>, body: &Body, all: &Bound<'_, PyDict>) -> PyResult<()> {
    let absent = |first: f64, length: usize| {
        let mut numbers = vec![0.0; length];
        numbers[0] = first;
        numbers
    };
    let inertial = body.inertial.clone().unwrap_or_default();
    let ipos = if body.inertial.is_some() { inertial.pos.to_vec() } else { absent(f64::NAN, 3) };
    let full = inertial.fullinertia.map_or_else(|| absent(f64::NAN, 6), |full| full.to_vec());
    all.set_item("explicitinertial", body.inertial.is_some())?;
    all.set_item("mass", inertial.mass)?;
    all.set_item("ipos", PyArray1::from_vec(py, ipos))?;
    all.set_item("iquat", PyArray1::from_slice(py, &inertial.quat))?;
    all.set_item("inertia", PyArray1::from_slice(py, &inertial.inertia))?;
    all.set_item("fullinertia", PyArray1::from_vec(py, full))?;
    all.set_item("ialt", orientation(inertial.alt))
}

/// The inertia of a body, when it is given: by its position, as explicit, or by a mass where no geom has one to give.
pub fn take_inertial(values: &Bound<'_, PyDict>, has_geoms: bool, loc: Loc) -> PyResult<Option<Inertial>> {
    let ipos: [f64; 3] = fixed(&required(values, "ipos")?)?;
    let mass: f64 = required(values, "mass")?.extract()?;
    let inertia: [f64; 3] = fixed(&required(values, "inertia")?)?;
    let full: [f64; 6] = fixed(&required(values, "fullinertia")?)?;
    let explicit = required(values, "explicitinertial")?.is_truthy()?;
    let given = mass != 0.0 || inertia != [0.0; 3] || !full[0].is_nan();
    if ipos[0].is_nan() && !explicit && (has_geoms || !given) {
        return Ok(None);
    }
    let pos = if ipos[0].is_nan() { [0.0; 3] } else { ipos };
    Ok(Some(Inertial {
        loc,
        mass,
        pos,
        quat: fixed(&required(values, "iquat")?)?,
        alt: take_orientation(values, "ialt")?,
        inertia,
        fullinertia: (!full[0].is_nan()).then_some(full),
    }))
}

/// The path of a tendon.
pub fn path(tendon: &Tendon) -> Vec<Step> {
    let step = |wrap: &Wrap| match &wrap.kind {
        WrapKind::Joint { joint, coef } => (1, joint.clone(), String::new(), *coef),
        WrapKind::Pulley { divisor } => (2, String::new(), String::new(), *divisor),
        WrapKind::Site { site } => (3, site.clone(), String::new(), 0.0),
        WrapKind::Geom { geom, sidesite } => (4, geom.clone(), sidesite.clone(), 0.0),
    };
    tendon.path.iter().map(step).collect()
}

/// The path that a tendon of Python has.
pub fn take_path(values: &Bound<'_, PyDict>, loc: Loc) -> PyResult<Vec<Wrap>> {
    let steps: Vec<Step> = required(values, "_steps")?.extract()?;
    let wrap = |(code, name, side, number): Step| {
        let kind = match code {
            1 => WrapKind::Joint { joint: name, coef: number },
            2 => WrapKind::Pulley { divisor: number },
            3 => WrapKind::Site { site: name },
            _ => WrapKind::Geom { geom: name, sidesite: side },
        };
        Wrap { loc, kind }
    };
    Ok(steps.into_iter().map(wrap).collect())
}

/// Adds the references of a tuple to its attributes.
pub fn show_entries(py: Python<'_>, tuple: &Tuple, all: &Bound<'_, PyDict>) -> PyResult<()> {
    let types: Vec<i32> = tuple.entries.iter().map(|entry| entry.objtype.code()).collect();
    let names: Vec<&str> = tuple.entries.iter().map(|entry| entry.objname.as_str()).collect();
    let numbers: Vec<f64> = tuple.entries.iter().map(|entry| entry.prm).collect();
    all.set_item("objtype", PyArray1::from_vec(py, types))?;
    all.set_item("objname", names)?;
    all.set_item("objprm", PyArray1::from_vec(py, numbers))
}

/// The references that a tuple of Python has.
pub fn take_entries(values: &Bound<'_, PyDict>) -> PyResult<Vec<TupleEntry>> {
    let types: Vec<i32> = required(values, "objtype")?.extract()?;
    let names: Vec<String> = required(values, "objname")?.extract()?;
    let numbers: Vec<f64> = required(values, "objprm")?.extract()?;
    if types.len() != names.len() || names.len() != numbers.len() {
        return Err(PyValueError::new_err(format!(
            "objtype, objname and objprm of a tuple have {}, {} and {} items; they need as many",
            types.len(),
            names.len(),
            numbers.len()
        )));
    }
    let entry = |((code, objname), prm)| {
        let objtype = ObjType::from_code(code);
        let objtype = objtype.ok_or_else(|| PyValueError::new_err(format!("no object has type {code}")))?;
        Ok(TupleEntry { objtype, objname, prm })
    };
    types.into_iter().zip(names).zip(numbers).map(entry).collect()
}

/// The share of an element in keyframes.
pub fn shares(keyed: &[Keyed]) -> Vec<Share> {
    let share = |own: &Keyed| {
        let part = PARTS.iter().position(|part| *part == own.part).unwrap_or(0);
        (own.key, part, own.values.clone())
    };
    keyed.iter().map(share).collect()
}

/// The share that an element of Python has in keyframes.
pub fn take_shares(values: &Bound<'_, PyDict>) -> PyResult<Vec<Keyed>> {
    let Some(item) = values.get_item("_shares")? else { return Ok(Vec::new()) };
    let all: Vec<Share> = item.extract()?;
    let keyed = |(key, part, values): Share| {
        let part = *PARTS.get(part).ok_or_else(|| PyValueError::new_err("no such part of a keyframe"))?;
        Ok(Keyed { key, part, values })
    };
    all.into_iter().map(keyed).collect()
}
