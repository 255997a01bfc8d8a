//! Protocol 1.0: servos of the series AX, RX, DX and EX, and MX with older firmware.
//!
//! Source: ROBOTIS e-Manual, page "DYNAMIXEL Protocol 1.0" and the control table of each model.

mod packet;
mod table;

pub(crate) use packet::PacketsV1;
pub use packet::{BROADCAST, Decoder, Packet, encode, error, instruction};
pub use table::{FAMILY, KINDS, MODELS, Model, TABLE, address, model};
