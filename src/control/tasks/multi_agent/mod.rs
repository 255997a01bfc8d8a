//! Several agents, each controlled by what it observes itself.

pub mod pair_trot;
mod wish;
