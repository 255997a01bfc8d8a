//! Robots and environments over a simulated Franka arm and hand, in virtual time.

mod driving;
mod environment;
mod faults;
#[cfg(unix)]
mod network;
mod rig;
mod workspace;
