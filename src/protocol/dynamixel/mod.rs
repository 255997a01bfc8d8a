//! Dynamixel servos: packets of protocol 2.0 and control tables.
//!
//! Source: ROBOTIS e-Manual, pages "DYNAMIXEL Protocol 2.0" and the control table of each model.

mod model;
mod packet;
mod registers;

pub use model::{MODELS, Mode, Model, POSITION_PER_TURN, hardware_error, model};
pub use packet::{BROADCAST, Corrupt, Decoder, Packet, encode, instruction, status_error};
pub use registers::{Access, Register, address};
