//! Steps, passes and resets: the calls that make a simulation go.

use super::call::{change, timed};
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use super::timed::{Timed, Timers};
use super::warned::{Notice, settle, tell};
use physics::data::Warning;
use physics::model::bounds::MAXVAL;
use physics::{
    Data as Simulation, Model as Compiled, StepError, forward, forward_after_step1, inverse, step, step1,
    step2,
};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps between looks at signals such as Ctrl-C.
const STEPS_AT_ONCE: usize = 1000;

/// Unstable simulations are reset with a warning instead of raising.
static RESETS: AtomicBool = AtomicBool::new(false);

/// A callback is set: passes are put together in Python (`functions/called.py`), which calls it between their stages.
static CALLED: AtomicBool = AtomicBool::new(false);

/// Whether some callback is set.
#[pyfunction]
pub fn set_called(called: bool) {
    CALLED.store(called, Ordering::Relaxed);
}

/// The function of that name that calls callbacks, where one is set.
fn with_callbacks<'py>(py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    if !CALLED.load(Ordering::Relaxed) {
        return Ok(None);
    }
    py.import("robohive.mujoco.functions.called")?.getattr(name).map(Some)
}

/// Whether unstable simulations are reset.
#[pyfunction]
pub fn resets() -> bool {
    RESETS.load(Ordering::Relaxed)
}

/// Whether unstable simulations are reset; returns what was set before.
#[pyfunction]
pub fn set_resets(resets: bool) -> bool {
    RESETS.swap(resets, Ordering::Relaxed)
}

/// Advances the simulation `steps` times by `way`, which meets bad values as chosen; adds what is to be told to `notices`.
pub fn advance(
    model: &Compiled,
    simulation: &mut Simulation,
    steps: usize,
    way: fn(&Compiled, &mut Simulation) -> Result<(), StepError>,
    notices: &mut Vec<Notice>,
) -> Result<(), Fault> {
    simulation.autoreset = RESETS.load(Ordering::Relaxed);
    for _ in 0..steps {
        let (warnings, time) = (simulation.warnings, simulation.state.time);
        way(model, simulation)?;
        if simulation.warnings != warnings {
            settle(simulation, &warnings, time, notices);
        }
    }
    Ok(())
}

/// Advances a simulation of Python's, and tells of what it warned.
fn go(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    steps: usize,
    way: fn(&Compiled, &mut Simulation) -> Result<(), StepError>,
) -> PyResult<()> {
    let mut notices = Vec::new();
    let counts = Some((Timed::Step, steps));
    let outcome = timed(py, m, d, counts, |model, data| advance(model, data, steps, way, &mut notices));
    tell(py, &notices)?;
    outcome
}

/// Advances the simulation by a time step. Optionally, repeat nstep times.
///
/// Raises:
///     FatalError: the simulation is unstable, a number is not finite, or the step needs too much memory. The data keep
///         the state for inspection.
#[pyfunction]
#[pyo3(signature = (m, d, nstep = 1))]
pub fn mj_step(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>, nstep: i64) -> PyResult<()> {
    let mut left = usize::try_from(nstep).unwrap_or(0);
    if let Some(step) = with_callbacks(py, "step")? {
        return step.call1((m, d, left)).map(drop);
    }
    loop {
        let now = left.min(STEPS_AT_ONCE);
        go(py, m, d, now, step)?;
        left -= now;
        if left == 0 {
            return Ok(());
        }
        py.check_signals()?;
    }
}

/// First half of a step: all that does not depend on controls and applied forces.
#[pyfunction]
pub fn mj_step1(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    if let Some(step1) = with_callbacks(py, "step1")? {
        return step1.call1((m, d)).map(drop);
    }
    go(py, m, d, 1, step1)
}

/// Second half of a step, after controls and forces have been set.
#[pyfunction]
pub fn mj_step2(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    if let Some(step2) = with_callbacks(py, "step2")? {
        return step2.call1((m, d)).map(drop);
    }
    go(py, m, d, 1, step2)
}

/// Computes everything that follows from the state and the inputs, up to accelerations and sensors.
#[pyfunction]
pub fn mj_forward(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    if let Some(forward) = with_callbacks(py, "forward")? {
        return forward.call1((m, d)).map(drop);
    }
    pass(py, m, d, forward)
}

/// A pass; where instability resets, controls that are not finite or too large count as zero, with a warning that is told
/// like those of steps.
fn pass(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    way: fn(&Compiled, &mut Simulation) -> Result<(), StepError>,
) -> PyResult<()> {
    let mut notices = Vec::new();
    let outcome = timed(py, m, d, Some((Timed::Forward, 1)), |model, data| {
        let (warnings, time) = (data.warnings, data.state.time);
        let bad = data.state.ctrl.iter().position(|ctrl| ctrl.is_nan() || ctrl.abs() > MAXVAL);
        let Some(bad) = bad.filter(|_| RESETS.load(Ordering::Relaxed)) else { return Ok(way(model, data)?) };
        data.warnings.bad_ctrl = Warning { last: bad, count: warnings.bad_ctrl.count + 1 };
        let none = vec![0.0; data.state.ctrl.len()];
        let given = std::mem::replace(&mut data.state.ctrl, none);
        let outcome = way(model, data);
        data.state.ctrl = given;
        settle(data, &warnings, time, &mut notices);
        Ok(outcome?)
    });
    tell(py, &notices)?;
    outcome
}

/// `mj_forward` without the stages before `skipstage` (`mjtStage`); sensors are computed whatever `skipsensor` says.
#[pyfunction(name = "mj_forwardSkip")]
pub fn mj_forward_skip(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    skipstage: i64,
    skipsensor: i64,
) -> PyResult<()> {
    if let Some(forward) = with_callbacks(py, "forward")? {
        return forward.call1((m, d, skipstage)).map(drop);
    }
    _ = skipsensor;
    // What depends on positions alone is the same when it is computed again.
    pass(py, m, d, if skipstage >= 2 { after_velocity } else { forward })
}

fn after_velocity(model: &Compiled, data: &mut Simulation) -> Result<(), StepError> {
    forward_after_step1(model, data);
    Ok(())
}

/// Computes the forces that make the present acceleration `qacc`, into `qfrc_inverse`.
#[pyfunction]
pub fn mj_inverse(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    timed(py, m, d, Some((Timed::Inverse, 1)), |model, data| Ok(inverse(model, data)?))
}

/// Returns to the reference configuration: all numbers as in new data.
#[pyfunction(name = "mj_resetData")]
pub fn mj_reset_data(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    d.get().wait(py).timers = Timers::default();
    change(py, m, d, |model, data| {
        clear(model, data);
        Ok(())
    })
}

/// Returns to keyframe `key`; to the reference configuration where there is no such keyframe.
#[pyfunction(name = "mj_resetDataKeyframe")]
pub fn mj_reset_data_keyframe(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    key: i64,
) -> PyResult<()> {
    d.get().wait(py).timers = Timers::default();
    change(py, m, d, |model, data| {
        clear(model, data);
        if let Some(key) = usize::try_from(key).ok().filter(|&key| key < model.nkey) {
            data.reset_to_key(model, key).map_err(|error| Fault::Value(error.to_string()))?;
        }
        Ok(())
    })
}

/// As new; the memory of contacts and constraints stays.
fn clear(model: &Compiled, data: &mut Simulation) {
    let budget = data.budget;
    *data = Simulation::new(model);
    data.budget = budget;
}
