//! Bodies with feet.

mod body;
mod legs;
mod seen;
pub mod trot;
pub mod walk;
mod wish;

pub use body::feet;
