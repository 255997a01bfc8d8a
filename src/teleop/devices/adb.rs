//! The log of a headset, from the adb server of this machine or another.

use super::open::{Decoder, Opened};
use crate::error::TeleopError;
use protocol::adb::{AdbError, Next, Opening};
use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

/// Starts the app of oculus_reader, and writes the log from now on; of everything else that Android logs nothing.
pub const COMMAND: &str = "am start -n com.rail.oculus.teleop/com.rail.oculus.teleop.MainActivity >/dev/null 2>&1; \
    exec logcat -T 1 -s wE9ryARX";

/// How long a server may take to answer.
const PATIENCE: Duration = Duration::from_secs(5);

impl Opened {
    /// The controllers of a Quest, by the adb server at an address: those of the only headset, or of the one with a serial
    /// number.
    ///
    /// # Errors
    /// No server is there, or it has no such headset; the error says what to do.
    pub fn quest_at(address: &str, serial: Option<&str>) -> Result<Self, TeleopError> {
        let refused = |message: String, fix: &str| TeleopError::Device {
            device: "Quest".to_owned(),
            path: None,
            message: format!("the adb server at {address}: {message}"),
            fix: fix.to_owned(),
        };
        let unreachable = |error: io::Error| {
            let fix = "start one with `adb start-server`, name another as --device quest:HOST:PORT, or read a pipe that \
                `adb logcat` writes to: `mkfifo quest; adb logcat -T 1 > quest &`, --path quest";
            refused(error.to_string(), fix)
        };
        let mut stream = connect(address).map_err(unreachable)?;
        let (mut opening, mut request) = Opening::new(serial, COMMAND);
        let mut bytes = [0; 4096];
        loop {
            stream.write_all(&request).map_err(unreachable)?;
            let count = match stream.read(&mut bytes) {
                Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
                read => read,
            };
            match opening.take(&bytes[..count.map_err(unreachable)?]) {
                Ok(Next::Wait) => request = Vec::new(),
                Ok(Next::Send(next)) => request = next,
                Ok(Next::Begun(first)) => {
                    stream.set_nonblocking(true).map_err(unreachable)?;
                    let mut opened = Opened::of(crate::Device::Quest, stream.into());
                    if let Decoder::Quest(quest) = opened.decoder() {
                        quest.feed(&first, &mut Vec::new());
                    }
                    return Ok(opened);
                }
                Err(error @ AdbError::Foreign(_)) => {
                    return Err(refused(error.to_string(), "name the server as --device quest:HOST:PORT"));
                }
                Err(error) => {
                    let fix = "connect the headset, allow debugging on it, and look at `adb devices`";
                    return Err(refused(error.to_string(), fix));
                }
            }
        }
    }
}

fn connect(address: &str) -> io::Result<TcpStream> {
    let mut outcome = Err(ErrorKind::AddrNotAvailable.into());
    for address in address.to_socket_addrs()? {
        outcome = TcpStream::connect_timeout(&address, PATIENCE);
        if outcome.is_ok() {
            break;
        }
    }
    let stream = outcome?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    Ok(stream)
}
