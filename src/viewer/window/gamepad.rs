//! The sticks of a gamepad, as Linux reports them (kernel documentation: input/joydev/joystick-api).

use std::io::{ErrorKind, Read};

/// Bytes of an event: time [ms] (u32), value (i16), type (u8), number (u8), in the order of the machine.
const EVENT: usize = 8;
/// Type of an event of an axis, and the bit of the first events, which say where everything stands.
const AXIS: u8 = 2;
const INITIAL: u8 = 0x80;
/// Most axes.
const AXES: usize = 32;
/// Share of its way within which a stick counts as released.
const RELEASED: f64 = 0.08;

/// A gamepad, and where its axes stand.
pub(super) struct Gamepad {
    events: Box<dyn Read>,
    axes: Vec<f64>,
    /// Bytes of an event that is not whole yet.
    rest: Vec<u8>,
}

impl Gamepad {
    /// The first that is connected.
    ///
    /// # Errors
    /// There is none, or it must not be read; elsewhere than on Linux gamepads are not read.
    pub(super) fn first() -> Result<Self, String> {
        open_first().map(Self::of)
    }

    /// A gamepad whose events are read from here.
    fn of(events: Box<dyn Read>) -> Self {
        Gamepad { events, axes: Vec::new(), rest: Vec::new() }
    }

    /// Takes the events since the last call.
    ///
    /// # Errors
    /// It was disconnected.
    pub(super) fn poll(&mut self) -> Result<(), String> {
        let mut bytes = [0; 64 * EVENT];
        loop {
            match self.events.read(&mut bytes) {
                Ok(0) => return Ok(()),
                Ok(count) => self.take(&bytes[..count]),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(()),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(format!("the gamepad is gone: {error}")),
            }
        }
    }

    fn take(&mut self, bytes: &[u8]) {
        self.rest.extend_from_slice(bytes);
        let whole = self.rest.len() / EVENT * EVENT;
        for event in self.rest[..whole].chunks_exact(EVENT) {
            let (value, number) = (i16::from_ne_bytes([event[4], event[5]]), event[7] as usize);
            if event[6] & !INITIAL == AXIS && number < AXES {
                self.axes.resize(self.axes.len().max(number + 1), 0.0);
                self.axes[number] = f64::from(value).max(-32767.0) / 32767.0;
            }
        }
        self.rest.drain(..whole);
    }

    /// Where the axes stand, -1 to 1; near the middle, 0.
    pub(super) fn axes(&self) -> impl Iterator<Item = f64> {
        self.axes.iter().map(|&axis| if axis.abs() < RELEASED { 0.0 } else { axis })
    }
}

#[cfg(target_os = "linux")]
fn open_first() -> Result<Box<dyn Read>, String> {
    use std::fs::OpenOptions;
    use std::os::unix::fs::OpenOptionsExt;
    /// `O_NONBLOCK` of Linux, on every processor that Rust's standard library supports but MIPS and SPARC.
    const NONBLOCK: i32 = 0o4000;
    let mut refused = None;
    for number in 0..8 {
        let path = format!("/dev/input/js{number}");
        match OpenOptions::new().read(true).custom_flags(NONBLOCK).open(&path) {
            Ok(file) => return Ok(Box::new(file)),
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => refused = Some(format!("{path}: {error}; members of the group input may read it")),
        }
    }
    Err(refused.unwrap_or_else(|| "no gamepad is connected: there is no /dev/input/js0".to_owned()))
}

#[cfg(not(target_os = "linux"))]
fn open_first() -> Result<Box<dyn Read>, String> {
    Err("gamepads are read on Linux alone; keys move the action everywhere".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(value: i16, kind: u8, number: u8) -> Vec<u8> {
        [&7_u32.to_ne_bytes()[..], &value.to_ne_bytes(), &[kind, number]].concat()
    }

    #[test]
    fn axes_follow_events_in_pieces_of_any_length() {
        let events = [
            event(i16::MIN, AXIS | INITIAL, 1),
            event(1, 1, 0),
            event(i16::MAX, AXIS, 0),
            event(1000, AXIS, 2),
            event(5, AXIS, 200),
        ];
        let bytes = events.concat();
        let mut gamepad = Gamepad::of(Box::new(std::io::empty()));
        bytes.chunks(3).for_each(|piece| gamepad.take(piece));
        assert_eq!(gamepad.axes().collect::<Vec<_>>(), [1.0, -1.0, 0.0]);
        let mut whole = Gamepad::of(Box::new(std::io::Cursor::new(bytes)));
        whole.poll().unwrap();
        assert_eq!(whole.axes().collect::<Vec<_>>(), [1.0, -1.0, 0.0]);
    }
}
