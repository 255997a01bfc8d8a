//! Real ports, and how drivers come by one.

mod serial;
mod socket;

pub use serial::{Serial, serial_ports};
pub(crate) use socket::NoNetwork;
pub use socket::{Network, Sockets};

use protocol::Port;
use std::io;
use std::sync::Arc;

/// Opens the port of a device by its name and speed; again when the connection was lost.
pub type Opener = Arc<dyn Fn(&str, u32) -> io::Result<Box<dyn Port>> + Send + Sync>;
