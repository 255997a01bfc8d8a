//! Bodies with feet.

pub(super) mod body;
pub(super) mod legs;
pub(super) mod seen;
pub mod swim;
pub mod trot;
pub mod walk;
pub(super) mod wish;

pub use body::feet;
