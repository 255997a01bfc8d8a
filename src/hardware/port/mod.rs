//! Ports of this machine, and how drivers open them.

mod cameras;
mod capture;
mod serial;
mod socket;
#[cfg(target_os = "linux")]
mod video;

pub(crate) use cameras::System;
pub use cameras::{Found, video_devices};
pub(crate) use capture::NoCaptures;
pub use capture::{Capture, Captures, Encoding, Format, Frame, Request, Source};
pub use serial::{Serial, serial_ports};
pub(crate) use socket::NoNetwork;
pub use socket::{Network, Sockets};

use protocol::Port;
use robot::Fault;
use std::io;
use std::sync::Arc;

/// Opens the port of a device by its name and speed; again when the connection was lost.
pub type Opener = Arc<dyn Fn(&str, u32) -> io::Result<Box<dyn Port>> + Send + Sync>;

/// An error of a port as a fault: the device is disconnected, or does not respond.
pub(crate) fn broken(error: &io::Error) -> Fault {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => Fault::Unreachable(format!("the connection is lost: {error}")),
        _ => Fault::Unreachable(error.to_string()),
    }
}
