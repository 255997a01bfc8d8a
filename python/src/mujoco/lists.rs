//! Arrays whose length changes from step to step: contacts, constraint rows, islands, iterations of the solver.

use super::data::Data;
use super::fresh::array;
use numpy::PyArray1;
use physics::data::SolverStat;
use physics::table::Slice;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What visits arrays by name.
type Visit<'a> = dyn Fn(&mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) + 'a;

fn gather<'py>(py: Python<'py>, visit: &Visit<'_>) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let mut result = Ok(());
    visit(&mut |name, shape, slice| {
        if result.is_ok() {
            result = array(py, slice, shape).and_then(|values| all.set_item(name, values));
        }
    });
    result.map(|()| all)
}

/// Every field of all contacts, by the field's name, until the simulation changes.
#[pyfunction]
pub fn contacts<'py>(py: Python<'py>, d: &Bound<'py, Data>) -> PyResult<Bound<'py, PyDict>> {
    let mut held = d.get().wait(py);
    if let Some(known) = &held.lent.contacts {
        return Ok(known.bind(py).clone());
    }
    let all = gather(py, &|f| {
        held.simulation
            .con
            .visit(&mut |name, shape, slice| f(name.trim_start_matches("contact."), shape, slice))
    })?;
    held.lent.contacts = Some(all.clone().unbind());
    Ok(all)
}

/// Arrays of constraint rows and islands by name, until the simulation changes.
#[pyfunction]
pub fn constraints<'py>(py: Python<'py>, d: &Bound<'py, Data>) -> PyResult<Bound<'py, PyDict>> {
    let mut held = d.get().wait(py);
    if let Some(known) = &held.lent.constraints {
        return Ok(known.bind(py).clone());
    }
    let all = gather(py, &|f| {
        held.simulation.efc.visit(f);
        held.simulation.island.visit(f);
    })?;
    held.lent.constraints = Some(all.clone().unbind());
    Ok(all)
}

/// The Jacobian of the constraint rows, dense, row-major.
#[pyfunction]
pub fn dense_jacobian<'py>(
    py: Python<'py>,
    d: &Bound<'py, Data>,
    nv: usize,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let held = d.get().wait(py);
    Ok(PyArray1::from_vec(py, held.simulation.efc.dense_jacobian(nv)))
}

/// Iterations and non-zeros of each island, and every iteration: improvement, gradient, slope, and the counts.
#[pyfunction]
pub fn solver<'py>(py: Python<'py>, d: &Bound<'py, Data>) -> PyResult<Bound<'py, PyDict>> {
    let held = d.get().wait(py);
    let statistics = &held.simulation.solver;
    let all = PyDict::new(py);
    all.set_item("solver_niter", &statistics.solver_niter)?;
    all.set_item("solver_nnz", &statistics.solver_nnz)?;
    let column = |value: fn(&SolverStat) -> f64| statistics.solver.iter().map(value).collect::<Vec<_>>();
    all.set_item("improvement", column(|s| s.improvement))?;
    all.set_item("gradient", column(|s| s.gradient))?;
    all.set_item("lineslope", column(|s| s.lineslope))?;
    all.set_item("nactive", column(|s| f64::from(s.nactive)))?;
    all.set_item("nchange", column(|s| f64::from(s.nchange)))?;
    all.set_item("neval", column(|s| f64::from(s.neval)))?;
    all.set_item("nupdate", column(|s| f64::from(s.nupdate)))?;
    Ok(all)
}
