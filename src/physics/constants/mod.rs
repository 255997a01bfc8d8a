//! Constants of a model, derived from its reference configuration.

mod inverse_weight;
pub mod length_range;
pub mod set_const;
pub mod statistic;
