//! A Franka arm and its hand, as far as the network shows them.
//!
//! [`Arm`] has a server (channel [`Arm::COMMANDS`]) and sends states (channel [`Arm::STATES`]); [`Hand`] likewise. The joints
//! are seven motors of the plant that are position servos: commanded positions are their targets to the bit, torques act on
//! them without gravity, which the arm carries itself.
//!
//! What is simulated: the session with either version, one motion at a time by joint positions, joint velocities or torques,
//! the limits of the joints, of their torques and of collisions, the extrapolation of commands that do not come and the stop
//! after twenty, reflexes and their recovery, the stop button. What is not: motions in space (answered as not possible),
//! filters, the model library, walls and guiding. Deviations of the arm from its path end no motion.

mod arm;
mod hand;
mod motion;
mod session;
mod urdf;

pub use arm::Arm;
pub use hand::Hand;
