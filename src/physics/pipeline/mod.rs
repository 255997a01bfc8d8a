//! The order of all stages: forward and inverse dynamics, the step, and batches of steps.

pub mod batch;
pub mod error;
pub mod forward;
pub mod inverse;
pub mod validity;
pub mod watch;
