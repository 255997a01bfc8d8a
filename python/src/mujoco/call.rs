//! A call into the engine: edits go in, the interpreter's lock is released, results come out.

use super::data::Data;
use super::error::Fault;
use super::model::Model;
use super::timed::Timed;
use physics::{Data as Simulation, Model as Compiled};
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Works on a simulation that may change: all that Python wrote is taken over before, all that it reads is up to date
/// after, also where the work fails.
///
/// # Errors
/// The simulation is of another model or in use, an edit does not fit, or the work fails.
pub fn change<R: Send>(
    py: Python<'_>,
    model: &Bound<'_, Model>,
    data: &Bound<'_, Data>,
    work: impl FnOnce(&Compiled, &mut Simulation) -> Result<R, Fault> + Send,
) -> PyResult<R> {
    timed(py, model, data, None, work)
}

/// [`change`], counted as that number of calls of what is timed.
pub fn timed<R: Send>(
    py: Python<'_>,
    model: &Bound<'_, Model>,
    data: &Bound<'_, Data>,
    counts: Option<(Timed, usize)>,
    work: impl FnOnce(&Compiled, &mut Simulation) -> Result<R, Fault> + Send,
) -> PyResult<R> {
    let compiled = model.get().current(py)?;
    let mut held = data.get().lock()?;
    held.check_fits(model.get())?;
    held.pull(py)?;
    let (simulation, start) = (&mut held.simulation, counts.map(|_| Instant::now()));
    let result = py.detach(|| caught(|| work(&compiled, simulation)));
    if let (Some((what, number)), Some(start)) = (counts, start) {
        held.timers.count(what, number, start);
    }
    held.push(py)?;
    Ok(result?)
}

/// Reads a simulation.
///
/// # Errors
/// As [`change`].
pub fn read<R>(
    py: Python<'_>,
    model: &Bound<'_, Model>,
    data: &Bound<'_, Data>,
    work: impl FnOnce(&Compiled, &Simulation) -> Result<R, Fault>,
) -> PyResult<R> {
    let compiled = model.get().current(py)?;
    let mut held = data.get().lock()?;
    held.check_fits(model.get())?;
    held.pull(py)?;
    Ok(caught(|| work(&compiled, &held.simulation))?)
}

/// A panic becomes an exception: it must not cross into the interpreter.
pub fn caught<R>(work: impl FnOnce() -> Result<R, Fault>) -> Result<R, Fault> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| Err(Fault::of_panic(&*payload)))
}
