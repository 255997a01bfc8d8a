//! Dynamixel servos: packets and control tables of protocol 2.0, and in [`v1`] those of protocol 1.0.
//!
//! Source: ROBOTIS e-Manual, pages "DYNAMIXEL Protocol 2.0" and the control table of each model.

mod model;
mod packet;
mod registers;
mod requests;
pub mod v1;

pub use model::{KINDS, MODELS, Mode, Model, POSITION_PER_TURN, hardware_error, model};
pub use packet::{BROADCAST, Corrupt, Decoder, Packet, encode, instruction, status_error};
pub use registers::{Access, Register, address};
pub use requests::FAMILY;
