//! Comparison of our physics and compiler with recorded MuJoCo runs.

pub mod reference;
