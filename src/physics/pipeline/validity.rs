//! What a step refuses: numbers that are not finite or too large, and models with features that are not simulated.
//! A bad state is an error, never a silent reset.

use crate::actuation::activation::clip;
use crate::actuation::dc_motor;
use crate::data::Data;
use crate::model::bounds::MAXVAL;
use crate::model::{
    BiasType, Cone, DynType, EqType, GainType, Integrator, JointType, Model, ObjType, Solver, TrnType,
    disable, enable,
};
use crate::{collision, sensor, velocity::bias};
use std::fmt;

/// Where a bad number was found.
#[derive(Clone, Debug, PartialEq)]
pub struct BadNumber {
    /// Index in the array.
    pub index: usize,
    /// Joint or actuator it belongs to.
    pub element: String,
    /// The number.
    pub value: f64,
    /// Simulation time [s].
    pub time: f64,
}

/// Why a step was not made.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError {
    /// A position is not finite or too large.
    BadQpos(BadNumber),
    /// A velocity is not finite or too large.
    BadQvel(BadNumber),
    /// An acceleration is not finite or too large: the simulation is unstable.
    BadQacc(BadNumber),
    /// A control is not finite or too large.
    BadCtrl(BadNumber),
    /// The model uses a feature that is not simulated.
    NotSimulated(String),
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (array, bad) = match self {
            StepError::BadQpos(bad) => ("qpos", bad),
            StepError::BadQvel(bad) => ("qvel", bad),
            StepError::BadQacc(bad) => ("qacc", bad),
            StepError::BadCtrl(bad) => ("ctrl", bad),
            StepError::NotSimulated(feature) => return write!(f, "{feature} not simulated"),
        };
        let BadNumber { index, element, value, time } = bad;
        write!(f, "{array}[{index}] of {element} is {value} at time {time}: not finite or too large")
    }
}

impl std::error::Error for StepError {}

/// Not a number, or beyond the bound.
fn is_bad(x: f64) -> bool {
    x.is_nan() || x.abs() > MAXVAL
}

/// Checks positions, velocities and controls, and that the options ask for what is simulated.
///
/// # Errors
/// The first that is bad.
pub(crate) fn check_state(m: &Model, d: &Data) -> Result<(), StepError> {
    check_options(m)?;
    check_array(m, d, &d.state.qpos, joint_of_qpos).map_err(StepError::BadQpos)?;
    check_array(m, d, &d.state.qvel, joint_of_dof).map_err(StepError::BadQvel)?;
    if m.opt.disableflags & disable::ACTUATION != 0 {
        return Ok(());
    }
    for (k, &u) in d.state.ctrl.iter().enumerate() {
        let clamped = m.actuator_ctrllimited[k] && m.opt.disableflags & disable::CLAMPCTRL == 0;
        if is_bad(if clamped { clip(u, m.actuator_ctrlrange[k]) } else { u }) {
            let i = (0..m.nactuator).rfind(|&i| m.actuator_ctrladr[i] as usize <= k).unwrap_or(0);
            let element = m.label_of(ObjType::Actuator, i);
            return Err(StepError::BadCtrl(BadNumber { index: k, element, value: u, time: d.time }));
        }
    }
    Ok(())
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
    match values.iter().position(|&x| is_bad(x)) {
        None => Ok(()),
        Some(index) => {
            let element = m.label_of(ObjType::Joint, joint(m, index));
            Err(BadNumber { index, element, value: values[index], time: d.time })
        }
    }
}

fn joint_of_dof(m: &Model, dof: usize) -> usize {
    m.dof_jntid[dof] as usize
}

fn joint_of_qpos(m: &Model, q: usize) -> usize {
    (0..m.njnt).rfind(|&j| m.jnt_qposadr[j] as usize <= q).unwrap_or(0)
}

/// Checks the options that decide how a step is made.
///
/// # Errors
/// The feature that is not simulated.
pub fn check_options(m: &Model) -> Result<(), StepError> {
    let refuse = |feature: &str| Err(StepError::NotSimulated(feature.to_owned()));
    match Integrator::from_code(m.opt.integrator) {
        Some(Integrator::Euler | Integrator::Rk4 | Integrator::Implicit | Integrator::Implicitfast) => {}
        None => return refuse("this integrator is"),
    }
    if Cone::from_code(m.opt.cone).is_none() {
        return refuse("this friction cone is");
    }
    if Solver::from_code(m.opt.solver).is_none() {
        return refuse("this constraint solver is");
    }
    if m.opt.enableflags & enable::SLEEP != 0 {
        return refuse("sleeping of islands is");
    }
    Ok(())
}

/// Pairs of bodies are kept as two numbers of 16 bits.
const MAX_BODIES: usize = 1 << 16;

/// Checks once that everything the model uses is simulated.
///
/// # Errors
/// The first feature that is not, with the element that asks for it.
pub fn check_model(m: &Model) -> Result<(), StepError> {
    check_options(m)?;
    if m.nbody > MAX_BODIES {
        return Err(StepError::NotSimulated(format!("a model of more than {MAX_BODIES} bodies is")));
    }
    check_actuators(m)?;
    for (e, &kind) in m.eq_type.iter().enumerate() {
        if !matches!(
            EqType::from_code(kind),
            Some(EqType::Connect | EqType::Weld | EqType::Joint | EqType::Tendon)
        ) {
            let label = m.label_of(ObjType::Equality, e);
            return Err(StepError::NotSimulated(format!("the type of equality {label} is")));
        }
    }
    if let Some(j) = (0..m.njnt).find(|&j| JointType::from_code(m.jnt_type[j]).is_none()) {
        return Err(StepError::NotSimulated(format!("the type of {} is", m.label_of(ObjType::Joint, j))));
    }
    collision::check(m).map_err(|e| StepError::NotSimulated(format!("{e}: this is")))?;
    sensor::check(m).map_err(|e| StepError::NotSimulated(format!("{e}: this is")))?;
    bias::check(m).map_err(|e| StepError::NotSimulated(format!("{e}: this is")))
}

fn check_actuators(m: &Model) -> Result<(), StepError> {
    for i in 0..m.nactuator {
        let part = if matches!(DynType::from_code(m.actuator_dyntype[i]), Some(DynType::User) | None)
            || !dc_motor::fits(m, i)
        {
            "dynamics"
        } else if matches!(GainType::from_code(m.actuator_gaintype[i]), Some(GainType::User) | None) {
            "gain"
        } else if matches!(BiasType::from_code(m.actuator_biastype[i]), Some(BiasType::User) | None) {
            "bias"
        } else if matches!(TrnType::from_code(m.actuator_trntype[i]), Some(TrnType::Undefined) | None) {
            "transmission"
        } else {
            continue;
        };
        let label = m.label_of(ObjType::Actuator, i);
        return Err(StepError::NotSimulated(format!("the {part} type of actuator {label} is")));
    }
    Ok(())
}
