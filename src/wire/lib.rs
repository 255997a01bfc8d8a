//! Devices that are not there: servos, arms and trackers that speak their protocols, moved by this project's physics.
//!
//! A [`Bench`] has a [`Plant`] (a model in motion) and devices on it, each behind a link. In virtual time a driver reaches
//! them through a [`VirtualPort`], so that a run is the same every time and takes no longer than its computation; in real
//! time [`serve`] offers them on pseudo-terminals and sockets, where any program can open them. Either way a seeded injector makes of
//! the link what cables and networks do: see [`Rates`].
//!
//! ```
//! # use physics as robohive_physics;
//! # use protocol as robohive_protocol;
//! use robohive_protocol::{Port, dynamixel};
//! use robohive_wire::{Bench, Carries, Plant, VirtualPort, dynamixel::{Bus, Servo}};
//! use std::sync::{Arc, Mutex};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>
//!      <actuator><position name='servo' joint='j' kp='5' kv='1'/></actuator></mujoco>",
//! )?
//! .model;
//! let plant = Plant::new(model)?;
//! let mut servo = Servo::new(&dynamixel::MODELS[0], 1);
//! servo.mount(plant.motor("servo")?, 1.0, std::f64::consts::PI);
//! let mut bench = Bench::new(plant);
//! let link = bench.connect(Box::new(Bus::new(vec![servo])), Carries::serial(57_600.0));
//! let mut port = VirtualPort::new(Arc::new(Mutex::new(bench)), link);
//!
//! let mut ping = Vec::new();
//! dynamixel::encode(&mut ping, 1, dynamixel::instruction::PING, &[]);
//! port.send(&ping)?;
//! let mut reply = [0; 64];
//! let count = port.receive(&mut reply, 0.1)?;
//! // Model 1020, firmware 48.
//! assert_eq!(reply[..count][9..12], [0xFC, 0x03, 48]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod adb;
mod bench;
mod chain;
pub mod cyberglove;
mod device;
pub mod dynamixel;
mod faults;
pub mod feetech;
pub mod franka;
pub mod optitrack;
mod plant;
mod profile;
mod rig;
pub mod robotiq;
#[cfg(unix)]
mod serve;
mod shaft;
mod virtual_port;

pub use bench::{Bench, Carries, LinkId};
pub use device::{Device, Moment, Outbox};
pub use faults::{Rates, RatesError};
pub use plant::{Drive, Plant, PlantError};
pub use rig::{Outlet, Rigged, connect, kinds, rig};
#[cfg(unix)]
pub use serve::{End, Terminal, serve};
pub use virtual_port::{Shared, VirtualClock, VirtualPort};
