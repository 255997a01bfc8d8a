//! Serial ports.

use protocol::Port;
use serial2::SerialPort;
use std::io::{self, ErrorKind};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// A serial port: 8 bits, no parity, one stop bit.
pub struct Serial {
    port: SerialPort,
    timeout: f64,
    start: Instant,
}

impl Serial {
    /// Opens the port at `path` with this many bits a second.
    ///
    /// # Errors
    /// The port is not there, not ours, or cannot be that fast: what to do about it.
    pub fn open(path: &str, baud: u32) -> io::Result<Serial> {
        let explain = |error: io::Error| {
            let hint = match error.kind() {
                ErrorKind::NotFound => {
                    let ports = serial_ports();
                    if ports.is_empty() {
                        "no serial port is connected; plug in the converter".to_owned()
                    } else {
                        format!("there are {}", ports.join(", "))
                    }
                }
                ErrorKind::PermissionDenied => {
                    "add yourself to the group that owns it (on Debian: sudo usermod -aG dialout $USER) and log in \
                     again"
                        .to_owned()
                }
                _ => "check that it is a serial port and takes this baud rate".to_owned(),
            };
            io::Error::new(error.kind(), format!("{path} at {baud} baud: {error}; {hint}"))
        };
        let mut port = SerialPort::open(path, baud).map_err(explain)?;
        let timeout = 0.01;
        port.set_read_timeout(Duration::from_secs_f64(timeout))?;
        Ok(Serial { port, timeout, start: Instant::now() })
    }
}

/// Serial ports of this machine, by path.
pub fn serial_ports() -> Vec<String> {
    let mut ports: Vec<_> = SerialPort::available_ports()
        .unwrap_or_default()
        .iter()
        .map(PathBuf::as_path)
        .map(|p| p.display().to_string())
        .collect();
    ports.sort();
    ports
}

/// A line that has gone reports it in several ways; all mean that the device is not there any more.
fn gone(error: io::Error) -> io::Error {
    match error.kind() {
        ErrorKind::BrokenPipe | ErrorKind::NotConnected | ErrorKind::ConnectionReset => {
            io::Error::new(ErrorKind::UnexpectedEof, "the port was disconnected")
        }
        _ => error,
    }
}

impl Port for Serial {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.port.write_all(bytes).map_err(gone)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        // The system counts in milliseconds; less would be no wait at all.
        let timeout = timeout.max(1e-3);
        if timeout != self.timeout {
            self.port.set_read_timeout(Duration::from_secs_f64(timeout))?;
            self.timeout = timeout;
        }
        match self.port.read(buffer) {
            Ok(0) => Err(io::Error::new(ErrorKind::UnexpectedEof, "the port was disconnected")),
            Ok(count) => Ok(count),
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::TimedOut | ErrorKind::Interrupted | ErrorKind::WouldBlock
                ) =>
            {
                Ok(0)
            }
            Err(error) => Err(gone(error)),
        }
    }

    fn discard(&mut self) -> io::Result<()> {
        self.port.discard_input_buffer().map_err(gone)
    }

    fn now(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn wait(&mut self, seconds: f64) {
        std::thread::sleep(Duration::try_from_secs_f64(seconds).unwrap_or_default());
    }
}
