//! Robots that are hardware, and devices that stand in for them.

pub mod calibrate;
pub mod devices;
pub mod hardware;
pub mod live;
pub mod rehearsal;
pub mod wire;
pub mod worn;
