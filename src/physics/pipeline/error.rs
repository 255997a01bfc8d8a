//! Why a step, a forward pass or a model is refused.
//!
//! ```
//! use robohive_physics::{Data, StepError, step};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint name='hinge' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! data.state.qvel[0] = f64::NAN;
//! match step(&model, &mut data) {
//!     Err(StepError::BadQvel(bad)) => assert!(bad.element.contains("hinge")),
//!     other => panic!("{other:?}"),
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use crate::model::NotSimulated;

use crate::math::Legible;
use crate::stages::OverBudget;
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
    /// Simulation time \[s\].
    pub time: f64,
}

/// Why a step was not made. The `Data` keeps the state for inspection.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A position is not finite or too large.
    BadQpos(BadNumber),
    /// A velocity is not finite or too large.
    BadQvel(BadNumber),
    /// An acceleration is not finite or too large: the simulation is unstable.
    BadQacc(BadNumber),
    /// A control is not finite or too large.
    BadCtrl(BadNumber),
    /// An activation is not finite after the step.
    BadAct(BadNumber),
    /// The time step is not positive and finite \[s\].
    BadTimestep(f64),
    /// `tree_asleep` names a tree that there is not.
    BadSleep {
        /// The tree.
        tree: usize,
        /// What stands there instead of the next tree of its island.
        next: i32,
    },
    /// Contacts and constraint rows need more memory than `Data::budget`.
    OverBudget(OverBudget),
    /// The model or the call uses a feature that is not simulated.
    NotSimulated(NotSimulated),
}

const UNSTABLE: &str = "the simulation is unstable: reduce the time step, gains or applied forces";
const SET_OR_UNSTABLE: &str =
    "check what sets it, or reduce the time step, gains or applied forces of an unstable simulation";

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (array, bad, hint) = match self {
            StepError::BadQpos(bad) => ("qpos", bad, SET_OR_UNSTABLE),
            StepError::BadQvel(bad) => ("qvel", bad, SET_OR_UNSTABLE),
            StepError::BadQacc(bad) => ("qacc", bad, UNSTABLE),
            StepError::BadCtrl(bad) => ("ctrl", bad, "check what sets the control"),
            StepError::BadAct(bad) => ("act", bad, UNSTABLE),
            StepError::BadTimestep(timestep) => {
                let timestep = Legible(timestep);
                return write!(f, "the time step is {timestep} s; it must be positive and finite");
            }
            StepError::BadSleep { tree, next } => {
                return write!(
                    f,
                    "tree_asleep[{tree}] is {next}; for a tree that sleeps it is the number of another tree of its island"
                );
            }
            StepError::OverBudget(over) => return over.fmt(f),
            StepError::NotSimulated(what) => return what.fmt(f),
        };
        let BadNumber { index, element, value, time } = bad;
        let fault = if value.is_finite() { "too large" } else { "not finite" };
        let (value, time) = (Legible(value), Legible(time));
        write!(f, "{array}[{index}] of {element} is {value} at time {time} s, which is {fault}; {hint}")
    }
}

impl std::error::Error for StepError {}

impl From<OverBudget> for StepError {
    fn from(over: OverBudget) -> Self {
        StepError::OverBudget(over)
    }
}

impl From<NotSimulated> for StepError {
    fn from(what: NotSimulated) -> Self {
        StepError::NotSimulated(what)
    }
}
