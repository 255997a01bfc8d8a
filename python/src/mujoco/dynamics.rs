//! Steps, passes and resets: the calls that make a simulation go.

use super::call::{change, change_held};
use super::data::{Data, Held};
use super::error::Fault;
use super::model::Model;
use physics::model::{Disable, Model as Compiled};
use physics::{StepError, forward, forward_after_step1, inverse, step, step1, step2};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps between looks at signals such as Ctrl-C.
const STEPS_AT_ONCE: usize = 1000;

/// Unstable simulations are reset with a warning instead of raising.
static RESETS: AtomicBool = AtomicBool::new(false);

/// Whether unstable simulations are reset; returns what was set before.
#[pyfunction]
pub fn set_resets(resets: bool) -> bool {
    RESETS.swap(resets, Ordering::Relaxed)
}

/// Advances the simulation by `nstep` time steps.
///
/// Raises:
///     FatalError: the simulation is unstable, a number is not finite, or the step needs too much memory. The data keep
///         the state for inspection.
#[pyfunction]
#[pyo3(signature = (m, d, nstep = 1))]
pub fn mj_step(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>, nstep: i64) -> PyResult<()> {
    let mut left = usize::try_from(nstep).unwrap_or(0);
    loop {
        let now = left.min(STEPS_AT_ONCE);
        change_held(py, m, d, |model, held| (0..now).try_for_each(|_| advance(model, held, step)))?;
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
    change_held(py, m, d, |model, held| advance(model, held, step1))
}

/// Second half of a step, after controls and forces have been set.
#[pyfunction]
pub fn mj_step2(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    change_held(py, m, d, |model, held| advance(model, held, step2))
}

/// Kinds of warnings that a reset counts, by MuJoCo's numbers.
const BAD_QPOS: usize = 3;
const BAD_QVEL: usize = 4;
const BAD_QACC: usize = 5;
const BAD_CTRL: usize = 6;

type Advance = fn(&Compiled, &mut physics::Data) -> Result<(), StepError>;

/// One call of `way`; where resets are chosen, a bad state is counted, reset and advanced again, as MuJoCo does, and a
/// bad control counts as no control.
pub fn advance(model: &Compiled, held: &mut Held, way: Advance) -> Result<(), Fault> {
    let before = held.simulation.state.time;
    let error = match way(model, &mut held.simulation) {
        Ok(()) => return Ok(()),
        Err(error) if !RESETS.load(Ordering::Relaxed) => return Err(error.into()),
        Err(error) => error,
    };
    let (kind, bad) = match &error {
        StepError::BadQpos(bad) => (BAD_QPOS, bad),
        StepError::BadQvel(bad) => (BAD_QVEL, bad),
        StepError::BadQacc(bad) => (BAD_QACC, bad),
        StepError::BadCtrl(bad) => (BAD_CTRL, bad),
        StepError::BadAct(_) => return Ok(()),
        _ => return Err(error.into()),
    };
    if held.simulation.state.time != before {
        // Found after the step: the next one will find it before.
        return Ok(());
    }
    let warning = &mut held.warnings[kind];
    (warning.last, warning.number) = (bad.index as i32, warning.number + 1);
    if kind == BAD_CTRL {
        let given = std::mem::take(&mut held.simulation.state.ctrl);
        held.simulation.state.ctrl = vec![0.0; given.len()];
        let result = way(model, &mut held.simulation);
        held.simulation.state.ctrl = given;
        return result.map_err(Fault::from);
    }
    if model.opt.disableflags.contains(Disable::AUTORESET) {
        return Err(error.into());
    }
    let counted = held.warnings;
    held.simulation.reset(model);
    held.warnings = counted;
    way(model, &mut held.simulation).map_err(Fault::from)
}

/// Computes everything that follows from the state and the inputs, up to accelerations and sensors.
#[pyfunction]
pub fn mj_forward(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    change(py, m, d, |model, data| Ok(forward(model, data)?))
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
    _ = skipsensor;
    change(py, m, d, |model, data| {
        // What depends on positions alone is the same when it is computed again.
        if skipstage >= 2 {
            forward_after_step1(model, data)
        } else {
            forward(model, data)?
        }
        Ok(())
    })
}

/// Computes the forces that make the present acceleration `qacc`, into `qfrc_inverse`.
#[pyfunction]
pub fn mj_inverse(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    change(py, m, d, |model, data| Ok(inverse(model, data)?))
}

/// Returns to the reference configuration: all numbers as in new data.
#[pyfunction(name = "mj_resetData")]
pub fn mj_reset_data(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<()> {
    change_held(py, m, d, |model, held| {
        clear(model, held);
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
    change_held(py, m, d, |model, held| {
        clear(model, held);
        if let Some(key) = usize::try_from(key).ok().filter(|&key| key < model.nkey) {
            held.simulation.reset_to_key(model, key).map_err(|error| Fault::Value(error.to_string()))?;
        }
        Ok(())
    })
}

/// As new; the memory of contacts and constraints stays.
fn clear(model: &Compiled, held: &mut Held) {
    let budget = held.simulation.budget;
    held.simulation = physics::Data::new(model);
    held.simulation.budget = budget;
    held.warnings = Default::default();
}
