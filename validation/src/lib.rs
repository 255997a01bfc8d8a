//! Comparison of our physics and compiler with recorded MuJoCo runs.

pub mod bits;
pub mod compare;
pub mod compile;
pub mod motion;
pub mod reference;
pub mod solver;
pub mod stages;
pub mod status;
pub mod tolerance;
