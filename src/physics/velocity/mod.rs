//! What depends on velocities: spatial velocities, bias forces, and passive forces.

pub mod bias;
pub mod com_vel;
pub(crate) mod fluid;
pub mod passive;
