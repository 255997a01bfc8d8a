//! Methods of control, a file for each: models, states and numbers in, motions and controls out. None of them knows an
//! environment.

/// A matrix, row after row.
#[cfg(test)]
macro_rules! dmatrix {
    ($($($x:expr),+);+) => {{
        let rows = [$([$($x),+]),+];
        nalgebra::DMatrix::from_row_slice(rows.len(), rows[0].len(), rows.as_flattened())
    }};
}

mod box_program;
mod dcm;
mod gait;
mod ilqr;
mod minimum_jerk;
mod no_solution;
mod operational_space;
mod polar_steering;
mod proposals;
mod riccati;
mod sampling;
mod simulated;
mod static_optimisation;

pub use dcm::{Pace, Pendulum};
pub use gait::{Gait, Steps};
pub use ilqr::{Dynamics, Ilqr, Plan, Quadratic};
pub use minimum_jerk::{Boundary, MinimumJerk};
pub use no_solution::NoSolution;
pub use operational_space::operational_torques;
pub use polar_steering::{PolarSteering, wrap};
pub use proposals::{Method, Proposals, Sample, interpolate};
pub use riccati::{Regulator, continuous, discrete};
pub use sampling::{Sampler, Settings};
pub use simulated::{Simulated, linearise};
pub use static_optimisation::{activations, activations_to};
