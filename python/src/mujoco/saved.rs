//! States as one vector: the parts that a signature of bits names, in the order of the state's table.

use super::call::{change, read};
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use numpy::{PyArray1, PyReadonlyArray1};
use physics::data::State;
use physics::table::{Slice, SliceMut};
use pyo3::prelude::*;

/// The bit of simulation time; array `k` of the state's table has the bit `1 << (k + 1)`.
const TIME: u32 = 1;

/// Bits with a meaning: time, then the arrays of the table.
const BITS: u32 = 14;

fn check(signature: i64) -> Result<u32, Fault> {
    u32::try_from(signature).ok().filter(|bits| *bits < 1 << BITS).ok_or_else(|| {
        let beyond = if signature < 0 { "< 0" } else { ">= 2^mjNSTATE" };
        Fault::Fatal(format!("mj_stateSize: invalid state signature {signature} {beyond}"))
    })
}

/// Numbers of the arrays that a signature names.
fn named(signature: u32) -> impl Iterator<Item = usize> {
    (0..BITS as usize - 1).filter(move |k| signature & (1 << (k + 1)) != 0)
}

/// Scalars of a state with this signature.
fn size(state: &State, signature: i64) -> Result<usize, Fault> {
    let bits = check(signature)?;
    let arrays: usize = named(bits).filter_map(|k| state.array(k)).map(|slice| slice.len()).sum();
    Ok(arrays + usize::from(bits & TIME != 0))
}

/// The parts of `state` that a signature names.
pub fn gather(state: &State, signature: i64) -> Result<Vec<f64>, Fault> {
    let bits = check(signature)?;
    let mut all = Vec::new();
    if bits & TIME != 0 {
        all.push(state.time);
    }
    for slice in named(bits).filter_map(|k| state.array(k)) {
        match slice {
            Slice::F64(values) => all.extend_from_slice(values),
            other => all.extend(other.to_f64()),
        }
    }
    Ok(all)
}

/// Writes what [`gather`] returned.
pub fn scatter(state: &mut State, signature: i64, values: &[f64]) -> Result<(), Fault> {
    let bits = check(signature)?;
    let mut rest = values;
    let mut take = |count: usize| {
        let (head, tail) = rest.split_at_checked(count).ok_or_else(|| misfit("shorter"))?;
        rest = tail;
        Ok::<_, Fault>(head)
    };
    if bits & TIME != 0 {
        state.time = take(1)?[0];
    }
    for k in named(bits) {
        match state.array_mut(k) {
            Some(SliceMut::F64(to)) => to.copy_from_slice(take(to.len())?),
            Some(SliceMut::Bool(to)) => {
                let from = take(to.len())?;
                to.iter_mut().zip(from).for_each(|(to, &x)| *to = x != 0.0);
            }
            _ => unreachable!("bits name numbers and truth values"),
        }
    }
    if rest.is_empty() { Ok(()) } else { Err(misfit("longer")) }
}

fn misfit(than: &str) -> Fault {
    Fault::Value(format!("the state is {than} than mj_stateSize says"))
}

/// Scalars of a state vector.
#[pyfunction]
pub fn state_size(py: Python<'_>, m: &Bound<'_, Model>, signature: i64) -> PyResult<usize> {
    let model = m.get().current(py)?;
    Ok(size(&State::new(&model), signature)?)
}

/// The parts of the state that `signature` names, as one vector.
#[pyfunction]
pub fn get_state<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    signature: i64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let values = read(py, m, d, |_, d| gather(&d.state, signature))?;
    Ok(PyArray1::from_vec(py, values))
}

/// Overwrites the parts of the state that `signature` names.
#[pyfunction]
pub fn set_state(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    values: PyReadonlyArray1<'_, f64>,
    signature: i64,
) -> PyResult<()> {
    let values: Vec<f64> = values.as_array().iter().copied().collect();
    change(py, m, d, |_, d| scatter(&mut d.state, signature, &values))
}
