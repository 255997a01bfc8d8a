//! Arrays whose length changes from step to step: contacts, constraint rows, islands, iterations of the solver. Those of
//! contacts, rows and islands are lent until the next call that changes the simulation, which first takes over what was
//! written into them; then there are others, since their length may be another.

use super::data::Data;
use super::fresh::array;
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use physics::Data as Simulation;
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

/// The arrays that Python was given since the simulation changed last, by name.
#[derive(Default)]
pub struct Lent {
    contacts: Option<Py<PyDict>>,
    constraints: Option<Py<PyDict>>,
}

impl Lent {
    /// Takes over what was written into the arrays.
    pub fn pull(&self, py: Python<'_>, simulation: &mut Simulation) -> PyResult<()> {
        for (name, values) in self.contacts.iter().flat_map(|all| all.bind(py).iter()) {
            if let Some(values) = numbers(&values) {
                simulation.con.assign(&format!("contact.{name}"), &values);
            }
        }
        for (name, values) in self.constraints.iter().flat_map(|all| all.bind(py).iter()) {
            if let Some(values) = numbers(&values) {
                let name: String = name.extract()?;
                simulation.efc.assign(&name, &values).or_else(|| simulation.island.assign(&name, &values));
            }
        }
        Ok(())
    }

    /// Forgets the arrays: the simulation has changed.
    pub fn recall(&mut self) {
        *self = Lent::default();
    }
}

/// The scalars of an array; `None` of what is no array that was lent.
fn numbers(values: &Bound<'_, PyAny>) -> Option<Vec<f64>> {
    if let Ok(values) = values.cast::<PyArrayDyn<f64>>() {
        return Some(values.readonly().as_array().iter().copied().collect());
    }
    let values = values.cast::<PyArrayDyn<i32>>().ok()?;
    Some(values.readonly().as_array().iter().map(|&x| f64::from(x)).collect())
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
