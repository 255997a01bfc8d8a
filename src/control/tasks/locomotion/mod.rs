//! Bodies with feet.

mod body;
pub(super) mod legs;
mod seen;
pub mod swim;
pub mod trot;
pub mod walk;
pub(super) mod wish;

pub use body::feet;
