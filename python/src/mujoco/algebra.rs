//! Products and solutions with the inertia matrix and the constraint Jacobian, positions and their differences, and
//! linearised dynamics.

use super::call::{change, read};
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use numpy::{PyArray1, PyReadonlyArray1};
use physics::inertia::{full_inertia, mul_inertia_matrix, solve};
use physics::integration::integrate::{differentiate_pos, integrate_pos};
use physics::pipeline::transition::{inverse_slope, transition};
use pyo3::prelude::*;

type Vector<'py> = Bound<'py, PyArray1<f64>>;

/// The numbers of an array, refused unless there are `count`.
fn numbers(values: &PyReadonlyArray1<'_, f64>, count: usize, name: &str) -> Result<Vec<f64>, Fault> {
    let values: Vec<f64> = values.as_array().iter().copied().collect();
    if values.len() == count {
        return Ok(values);
    }
    Err(Fault::Value(format!("{name} has {} numbers instead of {count}", values.len())))
}

/// The inertia matrix, dense, `nv * nv`.
#[pyfunction]
pub fn full_matrix<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
) -> PyResult<Vector<'py>> {
    let full = read(py, m, d, |m, d| Ok(full_inertia(m, &d.inertia.M)))?;
    Ok(PyArray1::from_vec(py, full))
}

/// `M v`.
#[pyfunction]
pub fn mul_inertia<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    v: PyReadonlyArray1<'py, f64>,
) -> PyResult<Vector<'py>> {
    let product = read(py, m, d, |m, d| {
        let v = numbers(&v, m.nv, "the vector")?;
        let mut out = vec![0.0; m.nv];
        mul_inertia_matrix(m, &d.inertia.M, &v, &mut out);
        Ok(out)
    })?;
    Ok(PyArray1::from_vec(py, product))
}

/// `M⁻¹ x` for every `nv` numbers of `x`, with the factor of the last forward pass.
#[pyfunction]
pub fn solve_inertia<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    x: PyReadonlyArray1<'py, f64>,
) -> PyResult<Vector<'py>> {
    let solution = read(py, m, d, |m, d| {
        let count = x.as_array().len();
        let mut x = numbers(&x, count - count % m.nv.max(1), "the vectors")?;
        x.chunks_exact_mut(m.nv.max(1)).for_each(|x| solve(m, &d.inertia, x));
        Ok(x)
    })?;
    Ok(PyArray1::from_vec(py, solution))
}

/// Positions after moving with `qvel` for `dt`.
#[pyfunction]
pub fn moved<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    qpos: PyReadonlyArray1<'py, f64>,
    qvel: PyReadonlyArray1<'py, f64>,
    dt: f64,
) -> PyResult<Vector<'py>> {
    let m = m.get().current(py)?;
    let mut qpos = numbers(&qpos, m.nq, "qpos")?;
    integrate_pos(&m, &mut qpos, &numbers(&qvel, m.nv, "qvel")?, dt);
    Ok(PyArray1::from_vec(py, qpos))
}

/// The velocity that moves positions `from` to `to` in `dt`.
#[pyfunction]
pub fn difference<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    from: PyReadonlyArray1<'py, f64>,
    to: PyReadonlyArray1<'py, f64>,
    dt: f64,
) -> PyResult<Vector<'py>> {
    let m = m.get().current(py)?;
    let (from, to) = (numbers(&from, m.nq, "qpos1")?, numbers(&to, m.nq, "qpos2")?);
    let mut qvel = vec![0.0; m.nv];
    differentiate_pos(&m, &from, &to, dt, &mut qvel);
    Ok(PyArray1::from_vec(py, qvel))
}

/// Slopes of one step, `A`, `B`, `C`, `D`, row-major.
#[pyfunction]
pub fn step_slopes<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    eps: f64,
    centred: bool,
) -> PyResult<[Vector<'py>; 4]> {
    let slopes = change(py, m, d, |m, d| Ok(transition(m, d, eps, centred)?))?;
    Ok([slopes.a, slopes.b, slopes.c, slopes.d].map(|values| PyArray1::from_vec(py, values)))
}

/// Slopes of inverse dynamics with position, velocity and acceleration, row-major.
#[pyfunction]
pub fn inverse_slopes<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    eps: f64,
) -> PyResult<[Vector<'py>; 3]> {
    let slopes = change(py, m, d, |m, d| Ok(inverse_slope(m, d, eps)?))?;
    Ok([slopes.position, slopes.velocity, slopes.acceleration].map(|values| PyArray1::from_vec(py, values)))
}
