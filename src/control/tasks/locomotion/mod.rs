//! Bodies with feet.

mod legs;
pub mod trot;
mod wish;
