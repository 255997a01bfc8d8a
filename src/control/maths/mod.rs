//! Methods of control, a file for each: models, states and numbers in, motions and controls out. None of them knows an
//! environment.

mod gait;
mod minimum_jerk;
mod no_solution;

pub use gait::{Gait, Steps};
pub use minimum_jerk::MinimumJerk;
pub use no_solution::NoSolution;
