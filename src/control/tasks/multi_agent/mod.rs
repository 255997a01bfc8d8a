//! Several agents, and controllers that act for all of them.

mod arm;
pub mod pair_arms;
pub mod pair_trot;
mod wish;
