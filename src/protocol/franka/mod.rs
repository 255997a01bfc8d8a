//! Franka arms and their hands: the Franka Control Interface, versions 5 (Panda) and 10 (FR3).
//!
//! Commands and their replies go over TCP ([`Command`], [`Request`]); over UDP the arm says its [`State`] a thousand times a
//! second, and each is answered with a [`Setpoint`]. The hand has a server of its own ([`hand`]).
//!
//! Sources: "Franka Control Interface documentation" (limits, Denavit-Hartenberg parameters), the headers of
//! `libfranka-common` for version 5 and the layouts that the crate `franka-rs` 0.4.0 (Apache-2.0) states for version 10.

mod command;
pub mod hand;
mod kinematics;
mod limits;
mod setpoint;
mod state;
mod status;

pub use command::{
    BadLength, Command, Controller, Decoder, Frame, Generator, Move, Request, Version, encode, reply_size,
    request_size,
};
pub use kinematics::{flange, identity};
pub use limits::{ArmLimits, FER, FR3, JOINTS, TORQUE, TORQUE_RATE};
pub use setpoint::Setpoint;
pub use state::{ERRORS, Field, Mode, State, describe_errors, error_bit, field};
pub use status::{MoveEnd, Outcome};

/// Port of the arm's server.
pub const PORT: u16 = 1337;
/// Port of the hand's server.
pub const HAND_PORT: u16 = 1338;
/// Time between two states, and between two commands \[s\].
pub const CYCLE: f64 = 1e-3;
/// Cycles without a command after which the arm stops.
pub const MISSED_CYCLES: u64 = 20;
