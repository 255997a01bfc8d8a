//! What devices of robots say on the wire: packets as bytes, control tables, checksums, and the ports that carry them.
//!
//! Everything here is pure: nothing is opened, no clock is read, nothing is drawn. Drivers (`robohive-hardware`) and the
//! simulated devices that they are proven against (`robohive-wire`) share these layouts, so each has one place. That both
//! sides read a document the same way does not prove that it was read right; `robohive-clients` therefore lets clients that
//! other people wrote talk to the simulated devices.
//!
//! | module | devices | source |
//! |---|---|---|
//! | [`adb`] | the adb server, which leads to the log of a headset | `OVERVIEW.TXT`, `SERVICES.TXT` of the Android Open Source Project |
//! | [`cyberglove`] | CyberGloves with 18 and 22 sensors | the CyberGlove's documentation, RoboHive's program Puppet |
//! | [`dynamixel`] | Dynamixel servos, protocols 2.0 and 1.0 | ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0" and "1.0", and the control tables of each model |
//! | [`feetech`] | Feetech servos of the STS series (arms SO-100, SO-101) | Feetech's protocol document and memory table |
//! | [`franka`] | Franka arms (versions 5 and 10) and the Franka Hand | Franka Control Interface documentation, headers of `libfranka-common`, layouts of `franka-rs` |
//! | [`modbus`] | anything on a line with Modbus RTU | "MODBUS over serial line", modbus.org |
//! | [`robotiq`] | Robotiq 2F-85, by Modbus RTU and by the gateway of Universal Robots' controllers | Robotiq 2F-85 instruction manual |
//! | [`optitrack`] | OptiTrack trackers: NatNet 3.0 and 4.1, and RoboHive's packet of 36 bytes | NatNet SDK documentation |
//!
//! [`servo`] is what servos of different makes have in common.
//!
//! Numbers on the wire are little-endian unless a page says otherwise.

pub mod adb;
pub mod crc;
pub mod cyberglove;
pub mod dynamixel;
pub mod feetech;
pub mod franka;
pub mod modbus;
pub mod optitrack;
mod port;
pub mod robotiq;
pub mod servo;

pub use port::Port;
