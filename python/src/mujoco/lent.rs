//! Arrays of contacts, constraint rows and islands, lent to Python until the next call that changes the simulation. That
//! call first takes over what was written into them; then there are others, since their length may be another.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use physics::Data as Simulation;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The arrays that Python was given since the simulation changed last, by name.
#[derive(Default)]
pub struct Lent {
    pub contacts: Option<Py<PyDict>>,
    pub constraints: Option<Py<PyDict>>,
    /// The dense Jacobian of the constraint rows, and the number of its columns.
    pub jacobian: Option<(usize, Py<PyArray1<f64>>)>,
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
        if let Some((columns, dense)) = &self.jacobian
            && let Some(values) = numbers(dense.bind(py).as_any())
            && values.len() == simulation.efc.nefc * columns
            && values != simulation.efc.dense_jacobian(*columns)
            && simulation.efc.set_dense_jacobian(*columns, &values)
        {
            (simulation.island.nisland, simulation.island.nidof) = (0, 0);
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
