//! A glove on a serial port.

use super::open::Opened;
use crate::error::TeleopError;
use crate::event::Device;
use protocol::cyberglove::{BAUD, COUNT, STOP, STREAM};
use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use std::os::fd::OwnedFd;
use std::path::Path;

impl Opened {
    /// The glove on a serial port, which streams from now on.
    ///
    /// # Errors
    /// The port is not there, or not ours; the error says what to do.
    pub fn glove(path: &Path) -> Result<Self, TeleopError> {
        let port = begin(path).map_err(|error| TeleopError::Device {
            device: "glove".to_owned(),
            path: Some(path.to_owned()),
            message: error.to_string(),
            fix: match error {
                Errno::ACCESS | Errno::PERM => {
                    "add yourself to the group that owns it (on Debian: sudo usermod -aG dialout $USER), and log in again"
                }
                _ => "name its serial port, as --device glove:/dev/ttyUSB0",
            }
            .to_owned(),
        })?;
        Ok(Opened::of(Device::Glove, port))
    }
}

/// Opens a port, and asks for samples; a stream that somebody left is ended first.
fn begin(path: &Path) -> Result<OwnedFd, Errno> {
    let flags = OFlags::RDWR | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    let port = rustix::fs::open(path, flags, Mode::empty())?;
    let mut settings = tcgetattr(&port)?;
    settings.make_raw();
    settings.set_speed(BAUD)?;
    tcsetattr(&port, OptionalActions::Flush, &settings)?;
    let mut request = &[STOP, COUNT[0], COUNT[1], STREAM][..];
    while !request.is_empty() {
        request = &request[rustix::io::write(&port, request)?..];
    }
    Ok(port)
}
