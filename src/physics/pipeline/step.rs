//! The time step, whole or in two halves (MuJoCo documentation, Computation, "Simulation pipeline").
//!
//! ```
//! use robohive_physics::{Data, step};
//!
//! let text = "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! (0..10).try_for_each(|_| step(&model, &mut data))?;
//! assert!((data.time() - 10.0 * model.opt.timestep).abs() < 1e-12 && data.state.qvel[2] < 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::Data;
use crate::model::{Enable, Integrator, Model};
use crate::pipeline::autoreset::{admit_acceleration, admit_result, recover, without_controls};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::{Known, evaluate, evaluate_after, forward_after_step1, position_and_velocity};
use crate::pipeline::integrate::{Factors, advance_once, integrate};
use crate::pipeline::inverse::compare_with_forward;
use crate::pipeline::validity::{check_acceleration, check_result, check_state};
use crate::pipeline::watch::{Stage, Watch};

/// Evaluations of a step of Runge-Kutta's method beyond the first.
const RK4_STAGES: usize = 3;

/// Advances the simulation by one time step.
///
/// # Errors
/// A state or input is not finite or too large, or the state after the step is, or contacts and
/// constraint rows need more memory than `Data::budget`; `d` keeps the state for inspection. With `Data::autoreset`
/// bad numbers are no errors.
pub fn step(m: &Model, d: &mut Data) -> Result<(), StepError> {
    step_watched(m, d, &mut ())
}

/// `step`, with an observer told of each stage as it ends.
///
/// # Errors
/// As `step`.
pub fn step_watched(m: &Model, d: &mut Data, watch: &mut impl Watch) -> Result<(), StepError> {
    if let Err(error) = check_state(m, d) {
        let bad_controls = matches!(error, StepError::BadCtrl(_));
        recover(m, d, error, |m, d| step_watched(m, d, watch))?;
        // Each evaluation of a step finds them.
        if bad_controls && m.opt.integrator == Integrator::Rk4 {
            d.warnings.bad_ctrl.count += RK4_STAGES;
        }
        return Ok(());
    }
    watch.ended(Stage::Checks);
    evaluate(m, d, true, watch)?;
    admit_acceleration(m, d)?;
    compare_if_asked(m, d)?;
    watch.ended(Stage::Checks);
    integrate(m, d, Factors::Fresh, watch)?;
    watch.ended(Stage::Integration);
    admit_result(m, d)
}

/// `step` where part of the last evaluation still holds; the integrator keeps the matrix factors that depend on it.
pub(crate) fn step_after(m: &Model, d: &mut Data, known: Known) -> Result<(), StepError> {
    check_state(m, d)?;
    evaluate_after(m, d, known, true, &mut ())?;
    check_acceleration(m, d)?;
    compare_if_asked(m, d)?;
    let holds = if m.opt.integrator == Integrator::Euler { Known::Position } else { Known::Velocity };
    integrate(m, d, if known >= holds { Factors::Kept } else { Factors::Fresh }, &mut ())?;
    check_result(m, d)
}

fn compare_if_asked(m: &Model, d: &mut Data) -> Result<(), StepError> {
    if m.opt.enableflags.contains(Enable::FWDINV) {
        compare_with_forward(m, d)?;
    }
    Ok(())
}

/// First half of a step: all that does not depend on controls and applied forces.
///
/// # Errors
/// As `step`.
pub fn step1(m: &Model, d: &mut Data) -> Result<(), StepError> {
    match check_state(m, d) {
        // The second half looks at the controls then given.
        Err(StepError::BadCtrl(_)) if d.autoreset => {}
        Err(error) => return recover(m, d, error, step1),
        Ok(()) => {}
    }
    position_and_velocity(m, d, Known::Nothing, true, &mut ())
}

/// Second half of a step, after inputs have been set; where Euler's method stands in for Runge-Kutta.
///
/// # Errors
/// As `step`.
pub fn step2(m: &Model, d: &mut Data) -> Result<(), StepError> {
    if let Err(error) = check_state(m, d) {
        return without_controls(m, d, error, step2);
    }
    forward_after_step1(m, d);
    admit_acceleration(m, d)?;
    compare_if_asked(m, d)?;
    advance_once(m, d, Factors::Fresh);
    admit_result(m, d)
}
