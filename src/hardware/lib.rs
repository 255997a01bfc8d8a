//! Drivers of real devices, behind the [`Device`](robot::Device) that a [`Robot`](robot::Robot) talks to.
//!
//! [`registry`] knows a driver for each `type` of interface that a robot's config may name; give it to
//! [`Robot::with_devices`](robot::Robot::with_devices) with `Options::with_hardware(true)`, and the same robot moves the
//! device instead of a simulation.
//!
//! | `type` | devices | page |
//! |---|---|---|
//! | `dynamixel` | Dynamixel servos with protocol 2.0 or 1.0 on a serial bus | [`dynamixel`] |
//! | `feetech` | Feetech servos of the STS series (arms SO-100, SO-101) on a serial bus | [`feetech`] |
//! | `franka` | Franka arms (Panda, FR3) over the Franka Control Interface, with the Franka Hand | [`franka`] |
//! | `robotiq` | Robotiq 2F-85 grippers, by Modbus RTU or behind a Universal Robots controller | [`robotiq`] |
//! | `optitrack` | OptiTrack trackers by NatNet, and RoboHive's packet | [`optitrack`] |
//! | `camera`, `realsense` | cameras, which are no [`Driver`]s: they move nothing, and show pictures instead of values | [`camera`] |
//!
//! # Safety
//!
//! A driver speaks its device's protocol and nothing else. Around each stands the same [`Guarded`] device, which
//! - takes a lock, so that no second program commands the device;
//! - moves nothing before [`Setup::armed`], and with [`Setup::dry_run`] says what it would send;
//! - refuses commands that are no finite numbers, and keeps the others within [`Limits`] of value and rate;
//! - begins from where the device stands, and moves to the start of an episode by minimum jerk;
//! - watches, in a thread of its own, that commands and readings come: after [`Timeouts`] without one the device is in its
//!   safe state, and stays there until the next reset;
//! - makes the device safe when the robot is dropped, by a panic too;
//! - keeps the last minutes in a [`recorder`] file, which a killed process leaves complete.
//!
//! # Real and virtual time
//!
//! A driver sees its device through a [`Port`](protocol::Port), and time through [`Setup`]'s clock. With the ports and the
//! clock of `robohive-wire` a robot runs against simulated devices in virtual time, to the bit the same every time.

pub mod calibration;
pub mod camera;
mod driver;
pub mod dynamixel;
pub mod feetech;
pub mod franka;
mod guard;
pub mod optitrack;
mod parameters;
mod port;
pub mod recorder;
mod registry;
pub mod robotiq;
mod safety;
mod service;
mod servos;
mod setup;

pub use driver::Driver;
pub use guard::Guarded;
pub use parameters::Parameters;
pub use port::{Network, Opener, Serial, Sockets, serial_ports};
pub use registry::{device, kinds, registry};
pub use safety::limits::Limits;
pub use safety::lock::Lock;
pub use safety::watchdog::Timeouts;
pub use service::{Services, TendedClock, TendedPort};
pub use servos::Servos;
pub use setup::{Clocks, Setup};
