//! Several agents, and controllers that act for all of them.

mod ball;
pub mod pair_arms;
pub mod pair_hands;
pub mod pair_trot;
mod wish;
