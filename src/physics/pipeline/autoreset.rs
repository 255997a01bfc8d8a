//! MuJoCo's way with bad values, where [`Data::autoreset`](crate::Data::autoreset) asks for it: a state or acceleration
//! that is not finite or too large is reset and counted, and the step goes on from the reference configuration. A control
//! that is bad counts as all controls zero for that step; the model's flag `autoreset` is about states alone.
//!
//! Meant for programs written for MuJoCo, and for comparison with recorded runs that contain such resets; by default a
//! bad value is an error.
//!
//! ```
//! use robohive_physics::{Data, step};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! data.autoreset = true;
//! data.state.qvel[0] = f64::NAN;
//! step(&model, &mut data)?;
//! assert_eq!((data.warnings.bad_qvel.count, data.time()), (1, model.opt.timestep));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::Data;
use crate::model::{Disable, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::forward;
use crate::pipeline::validity::{check_acceleration, check_result, check_state};

/// True where a bad value is reset: the data ask for it, and the model has the flag `autoreset` on.
fn resets(m: &Model, d: &Data) -> bool {
    d.autoreset && !m.opt.disableflags.contains(Disable::AUTORESET)
}

/// Goes on after a check of state and controls has failed: `again` begins at the reference configuration, or has no
/// controls.
///
/// # Errors
/// What cannot be reset, `error` where nothing is, or what `again` refuses.
#[cold]
pub(crate) fn recover(
    m: &Model,
    d: &mut Data,
    error: StepError,
    again: impl FnOnce(&Model, &mut Data) -> Result<(), StepError>,
) -> Result<(), StepError> {
    match &error {
        StepError::BadQpos(bad) if resets(m, d) => d.warnings.bad_qpos.note(bad.index),
        StepError::BadQvel(bad) if resets(m, d) => d.warnings.bad_qvel.note(bad.index),
        _ => return without_controls(m, d, error, again),
    }
    d.reset(m);
    check_state(m, d)?;
    again(m, d)
}

/// Goes on after a check has failed where only controls can be given up. They stay as they were given, unless a reset of
/// the state clears them.
///
/// # Errors
/// As [`recover`].
#[cold]
pub(crate) fn without_controls(
    m: &Model,
    d: &mut Data,
    error: StepError,
    again: impl FnOnce(&Model, &mut Data) -> Result<(), StepError>,
) -> Result<(), StepError> {
    match &error {
        StepError::BadCtrl(bad) if d.autoreset => d.warnings.bad_ctrl.note(bad.index),
        _ => return Err(error),
    }
    let none = vec![0.0; d.state.ctrl.len()];
    let given = std::mem::replace(&mut d.state.ctrl, none);
    let resets = d.warnings.resets();
    let outcome = check_state(m, d).and_then(|()| again(m, d));
    if d.warnings.resets() == resets {
        d.state.ctrl = given;
    }
    outcome
}

/// Checks accelerations; where a bad one is reset, evaluates everything at the reference configuration.
///
/// # Errors
/// What cannot be reset.
pub(crate) fn admit_acceleration(m: &Model, d: &mut Data) -> Result<(), StepError> {
    match check_acceleration(m, d) {
        Err(StepError::BadQacc(bad)) if resets(m, d) => d.warnings.bad_qacc.note(bad.index),
        outcome => return outcome,
    }
    d.reset(m);
    forward(m, d)?;
    check_acceleration(m, d)
}

/// Checks the state that a step made. Where bad ones are reset, that is done by the next step.
///
/// # Errors
/// The first number that is bad.
pub(crate) fn admit_result(m: &Model, d: &Data) -> Result<(), StepError> {
    if resets(m, d) { Ok(()) } else { check_result(m, d) }
}
