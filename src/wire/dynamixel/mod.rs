//! Dynamixel servos on a bus: protocol 2.0, and in [`v1`] protocol 1.0.

mod instructions;
mod memory;
mod servo;
pub mod v1;

pub use servo::Servo;

/// Servos with protocol 2.0 on one line.
pub type Bus = crate::chain::Bus<Servo>;
