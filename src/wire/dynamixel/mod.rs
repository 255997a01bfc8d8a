//! Dynamixel servos on a bus, protocol 2.0.

mod bus;
mod memory;
mod profile;
mod servo;

pub use bus::Bus;
pub use servo::Servo;
