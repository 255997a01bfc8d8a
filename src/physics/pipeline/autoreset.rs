//! MuJoCo's way with bad values, where [`Data::autoreset`](crate::Data::autoreset) asks for it: a state or acceleration
//! that is not finite or too large is reset and counted, and the step goes on from the reference configuration.
//!
//! Meant for comparison with recorded runs that contain such resets; by default a bad value is an error.
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
//! assert_eq!((data.warnings.bad_qvel, data.time()), (1, model.opt.timestep));
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

/// Checks the state and the controls; resets the former and zeroes the latter where that is asked for.
///
/// # Errors
/// What cannot be reset.
pub(crate) fn admit_state(m: &Model, d: &mut Data) -> Result<(), StepError> {
    let Err(error) = check_state(m, d) else { return Ok(()) };
    if !resets(m, d) {
        return Err(error);
    }
    match error {
        StepError::BadQpos(_) => d.warnings.bad_qpos += 1,
        StepError::BadQvel(_) => d.warnings.bad_qvel += 1,
        error => return zero_controls(d, error),
    }
    d.reset(m);
    check_state(m, d)
}

/// Checks state and controls in the middle of a step, where only controls can be given up.
///
/// # Errors
/// The state is bad, or a control where nothing is reset.
pub(crate) fn admit_controls(m: &Model, d: &mut Data) -> Result<(), StepError> {
    match check_state(m, d) {
        Err(error) if resets(m, d) => zero_controls(d, error),
        outcome => outcome,
    }
}

fn zero_controls(d: &mut Data, error: StepError) -> Result<(), StepError> {
    let StepError::BadCtrl(_) = error else { return Err(error) };
    d.warnings.bad_ctrl += 1;
    d.state.ctrl.fill(0.0);
    Ok(())
}

/// Checks accelerations; where a bad one is reset, evaluates everything at the reference configuration.
///
/// # Errors
/// What cannot be reset.
pub(crate) fn admit_acceleration(m: &Model, d: &mut Data) -> Result<(), StepError> {
    let Err(error) = check_acceleration(m, d) else { return Ok(()) };
    if !resets(m, d) {
        return Err(error);
    }
    d.warnings.bad_qacc += 1;
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
