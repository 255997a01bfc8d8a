//! Arrays whose length changes from step to step: contacts, constraint rows, islands.

use super::call::change;
use super::data::{Data, Held};
use super::error::Fault;
use super::fresh::array;
use super::model::Model;
use numpy::PyArray1;
use physics::data::{Constraints, Contact, Islands};
use physics::table::Slice;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;

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

/// The Jacobian of the constraint rows, dense, row-major, until the simulation changes.
#[pyfunction]
pub fn dense_jacobian<'py>(
    py: Python<'py>,
    d: &Bound<'py, Data>,
    nv: usize,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let mut held = d.get().wait(py);
    if let Some((_, known)) = &held.lent.jacobian {
        return Ok(known.bind(py).clone());
    }
    let Held { lent, simulation, .. } = &mut *held;
    lent.pull(py, simulation)?;
    let dense = PyArray1::from_vec(py, held.simulation.efc.dense_jacobian(nv));
    held.lent.jacobian = Some((nv, dense.clone().unbind()));
    Ok(dense)
}

/// Bytes that a constraint row takes, its entries of the Jacobian aside.
const ROW_BYTES: usize = 256;
/// Bytes of an entry of the Jacobian: number and column.
const ENTRY_BYTES: usize = size_of::<f64>() + size_of::<i32>();

/// Makes room for contacts, constraint rows and entries of their Jacobian, all zero, for programs that fill them in.
#[pyfunction]
pub fn make_rows(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    sizes: (usize, usize, usize),
) -> PyResult<()> {
    let (ncon, nefc, entries) = sizes;
    change(py, m, d, |_, d| {
        d.con.contact.clear();
        (d.efc, d.island) = <(Constraints, Islands)>::default();
        let parts = [(ncon, size_of::<Contact>()), (nefc, ROW_BYTES), (entries, ENTRY_BYTES)];
        let needed =
            parts.iter().fold(0_usize, |sum, &(count, size)| sum.saturating_add(count.saturating_mul(size)));
        if needed > d.budget.bytes {
            return Err(Fault::Fatal(format!(
                "{ncon} contacts and {nefc} constraint rows need {needed} bytes, more than the budget of {}",
                d.budget.bytes
            )));
        }
        d.con.contact.resize(ncon, Contact::default());
        let mut names = Vec::new();
        d.efc.visit(&mut |name, shape, _| names.push((name, shape.get(1).copied().unwrap_or(1))));
        for (name, columns) in names.into_iter().filter(|(name, _)| name.starts_with("efc_")) {
            let rows = if matches!(name, "efc_J" | "efc_J_colind") { entries } else { nefc };
            d.efc.assign(name, &vec![0.0; rows * columns]);
        }
        d.efc.nefc = nefc;
        Ok(())
    })
}

/// Makes room for islands of `nidof` degrees of freedom in sum, all zero, for programs that fill them in.
#[pyfunction]
pub fn make_islands(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    sizes: (usize, usize),
) -> PyResult<()> {
    let (nisland, nidof) = sizes;
    change(py, m, d, |m, d| {
        d.island = Islands::default();
        if nisland > m.ntree || nidof > m.nv {
            return Err(Fault::Fatal(format!(
                "{nisland} islands of {nidof} degrees of freedom: the model has {} trees and {} degrees of freedom",
                m.ntree, m.nv
            )));
        }
        let mut names = Vec::new();
        d.island.visit(&mut |name, _, _| names.push(name));
        for name in names {
            let rows = match name {
                "tree_island" | "map_itree2tree" => m.ntree,
                "dof_island" | "map_dof2idof" | "map_idof2dof" => m.nv,
                "efc_island" | "map_efc2iefc" | "map_iefc2efc" => d.efc.nefc,
                _ => nisland,
            };
            d.island.assign(name, &vec![0.0; rows]);
        }
        (d.island.nisland, d.island.nidof) = (nisland, nidof);
        Ok(())
    })
}

/// Replaces all contacts by those of these fields, each a number a contact or more, by name.
#[pyfunction]
pub fn set_contacts(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    fields: HashMap<String, Vec<f64>>,
) -> PyResult<()> {
    change(py, m, d, |_, d| {
        d.con.contact.clear();
        for (name, values) in &fields {
            d.con.assign(&format!("contact.{name}"), values);
        }
        Ok(())
    })
}
