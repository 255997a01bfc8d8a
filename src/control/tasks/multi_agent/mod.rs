//! Several agents, and controllers that act for all of them.

pub mod pair_arms;
pub mod pair_trot;
mod wish;
