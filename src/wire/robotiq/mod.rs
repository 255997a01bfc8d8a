//! A Robotiq 2F-85: [`Gripper`] is what it does, [`Rtu`] and [`Gateway`] are the two lines that lead to it.
//!
//! Simulated: activation, during which the fingers close and open once; motions at a commanded speed; objects between the
//! fingers; faults, and what clears them. The strength of a grip is that of the plant's motor.

mod gateway;
mod gripper;
mod rtu;

pub use gateway::Gateway;
pub use gripper::Gripper;
pub use rtu::Rtu;
