//! What a step refuses: numbers that are not finite or too large, and models with features that are not simulated.
//! A bad state is an error, never a silent reset.

use crate::actuation::dc_motor;
use crate::actuation::setpoint::activations;
use crate::data::Data;
use crate::math::clip;
use crate::model::NotSimulated;
use crate::model::bounds::MAXVAL;
use crate::model::{BiasType, Disable, DynType, EqType, GainType, JointType, Model, ObjType, TrnType};
use crate::pipeline::error::{BadNumber, StepError};
use crate::pipeline::reset;
use crate::{collision, flex, sensor, sleep, velocity::bias};
use std::fmt;

/// Not a number, or beyond the bound.
fn is_bad(x: f64) -> bool {
    x.is_nan() || x.abs() > MAXVAL
}

/// Checks the time step, positions, velocities and controls, and that the options ask for what is simulated.
///
/// # Errors
/// The first that is bad.
pub(crate) fn check_state(m: &Model, d: &Data) -> Result<(), StepError> {
    if m.nflex > 0 {
        check_options(m)?;
    }
    if !(m.opt.timestep > 0.0 && m.opt.timestep.is_finite()) {
        return Err(StepError::BadTimestep(m.opt.timestep));
    }
    check_motion(m, d)?;
    if m.opt.disableflags.contains(Disable::ACTUATION) {
        return Ok(());
    }
    for (k, &u) in d.state.ctrl.iter().enumerate() {
        let clamped = m.actuator_ctrllimited[k] && !m.opt.disableflags.contains(Disable::CLAMPCTRL);
        if is_bad(if clamped { clip(u, m.actuator_ctrlrange[k]) } else { u }) {
            let i = (0..m.nactuator).rfind(|&i| m.actuator_ctrladr[i] as usize <= k).unwrap_or(0);
            let element = m.label_of(ObjType::Actuator, i);
            return Err(StepError::BadCtrl(BadNumber { index: k, element, value: u, time: d.state.time }));
        }
    }
    Ok(())
}

fn check_motion(m: &Model, d: &Data) -> Result<(), StepError> {
    check_array(m, d, &d.state.qpos, joint_of_qpos).map_err(StepError::BadQpos)?;
    check_array(m, d, &d.state.qvel, joint_of_dof).map_err(StepError::BadQvel)?;
    if sleep::is_on(m) {
        let beyond = |&next: &i32| usize::try_from(next).is_ok_and(|next| next >= m.ntree);
        if let Some(tree) = d.state.tree_asleep.iter().position(beyond) {
            return Err(StepError::BadSleep { tree, next: d.state.tree_asleep[tree] });
        }
    }
    Ok(())
}

/// Checks the state that a step made: a simulation that diverges fails in the step that diverges.
///
/// # Errors
/// The first number that is bad.
pub(crate) fn check_result(m: &Model, d: &Data) -> Result<(), StepError> {
    check_motion(m, d)?;
    match d.state.act.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(index) => {
            let i = (0..m.nactuator).rfind(|&i| activations(m, i).contains(&index)).unwrap_or(0);
            let element = m.label_of(ObjType::Actuator, i);
            let value = d.state.act[index];
            Err(StepError::BadAct(BadNumber { index, element, value, time: d.state.time }))
        }
    }
}

/// Checks accelerations.
///
/// # Errors
/// The first that is bad.
pub(crate) fn check_acceleration(m: &Model, d: &Data) -> Result<(), StepError> {
    check_array(m, d, &d.acc.qacc, joint_of_dof).map_err(StepError::BadQacc)
}

fn check_array(
    m: &Model,
    d: &Data,
    values: &[f64],
    joint: fn(&Model, usize) -> usize,
) -> Result<(), BadNumber> {
    // Without branches, which vectorises; NaN compares as false.
    if values.iter().fold(true, |good, x| good & (x.abs() <= MAXVAL)) {
        return Ok(());
    }
    match values.iter().position(|&x| is_bad(x)) {
        None => Ok(()),
        Some(index) => {
            let element = m.label_of(ObjType::Joint, joint(m, index));
            Err(BadNumber { index, element, value: values[index], time: d.state.time })
        }
    }
}

fn joint_of_dof(m: &Model, dof: usize) -> usize {
    m.dof_jntid[dof] as usize
}

fn joint_of_qpos(m: &Model, q: usize) -> usize {
    (0..m.njnt).rfind(|&j| m.jnt_qposadr[j] as usize <= q).unwrap_or(0)
}

/// A tree that is to begin asleep and cannot: its first body, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartError(String);

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for StartError {}

/// Checks once that the trees which begin asleep can.
///
/// # Errors
/// The first body whose tree cannot, and why.
pub fn check_start(m: &Model) -> Result<(), StartError> {
    reset::check(m).map_err(StartError)
}

/// Checks that the options ask for what is simulated.
///
/// # Errors
/// The feature that is not simulated.
pub fn check_options(m: &Model) -> Result<(), NotSimulated> {
    flex::check_options(m)
}

/// Pairs of bodies are kept as two numbers of 16 bits.
const MAX_BODIES: usize = 1 << 16;

/// Checks once that everything the model uses is simulated.
///
/// # Errors
/// The first feature that is not, with the element that asks for it.
pub fn check_model(m: &Model) -> Result<(), NotSimulated> {
    check_options(m)?;
    if m.nbody + m.nflex > MAX_BODIES {
        let limit = format!("models of more than {MAX_BODIES} bodies and flexes");
        return Err(NotSimulated::feature(&limit));
    }
    check_actuators(m)?;
    for (e, &kind) in m.eq_type.iter().enumerate() {
        if matches!(EqType::from_code(kind), Some(EqType::Distance) | None) {
            return Err(NotSimulated::of(
                m.label_of(ObjType::Equality, e),
                "this type of equality constraint",
            ));
        }
    }
    if let Some(j) = (0..m.njnt).find(|&j| JointType::from_code(m.jnt_type[j]).is_none()) {
        return Err(NotSimulated::of(m.label_of(ObjType::Joint, j), "this type of joint"));
    }
    flex::check(m)?;
    collision::check(m)?;
    sensor::check(m)?;
    bias::check(m)
}

fn check_actuators(m: &Model) -> Result<(), NotSimulated> {
    for i in 0..m.nactuator {
        let part = if DynType::from_code(m.actuator_dyntype[i]).is_none() || !dc_motor::fits(m, i) {
            "dynamics"
        } else if GainType::from_code(m.actuator_gaintype[i]).is_none() {
            "gain"
        } else if BiasType::from_code(m.actuator_biastype[i]).is_none() {
            "bias"
        } else if matches!(TrnType::from_code(m.actuator_trntype[i]), Some(TrnType::Undefined) | None) {
            "transmission"
        } else {
            continue;
        };
        return Err(NotSimulated::of(
            m.label_of(ObjType::Actuator, i),
            &format!("this type of actuator {part}"),
        ));
    }
    Ok(())
}
