//! Gamepads, from the events of Linux's input devices (kernel documentation, input/event-codes and input/gamepad): 24 bytes
//! each on 64-bit machines.

use crate::event::{Axis, Button, Device, Event, Lost};

/// Bytes of an event: seconds and microseconds (8 bytes each), type and code (2 each), value (4), in the order of the machine.
pub const EVENT: usize = 24;
/// Types of events.
const SYN: u16 = 0;
const KEY: u16 = 1;
const ABS: u16 = 3;
/// Codes of `SYN`.
const REPORT: u16 = 0;
const DROPPED: u16 = 3;

/// Buttons by the names of mapping files.
pub const BUTTONS: [(&str, u16); 13] = [
    ("south", 304),
    ("east", 305),
    ("north", 307),
    ("west", 308),
    ("tl", 310),
    ("tr", 311),
    ("tl2", 312),
    ("tr2", 313),
    ("select", 314),
    ("start", 315),
    ("mode", 316),
    ("thumbl", 317),
    ("thumbr", 318),
];

/// Axes by the names of mapping files.
pub const AXES: [(&str, u16); 8] =
    [("x", 0), ("y", 1), ("z", 2), ("rx", 3), ("ry", 4), ("rz", 5), ("hat_x", 16), ("hat_y", 17)];

/// Share of its way within which a stick counts as released.
const DEAD: f64 = 0.1;

/// The values at the ends of an axis. An axis whose first end is 0 and whose code is a trigger's rests there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ends {
    /// The least value.
    pub low: i32,
    /// The largest value.
    pub high: i32,
    /// It rests at the least value rather than in the middle.
    pub rests_low: bool,
}

/// Ends of the axes of pads that speak xpad's language; one of a mapping file goes before.
fn usual(code: u16) -> Ends {
    match code {
        // Triggers: 255 on the 360, 1023 on the One; the larger is taken when a value asks for it.
        2 | 5 => Ends { low: 0, high: 255, rests_low: true },
        16 | 17 => Ends { low: -1, high: 1, rests_low: false },
        _ => Ends { low: -32768, high: 32767, rests_low: false },
    }
}

/// Decodes the events of a gamepad.
#[derive(Debug, Default)]
pub struct Gamepad {
    rest: Vec<u8>,
    ends: Vec<(u16, Ends)>,
    /// Events were left out, and what follows until the next report is not whole.
    dropped: bool,
}

impl Gamepad {
    /// A gamepad whose axes have these ends.
    pub fn with_ends(ends: Vec<(u16, Ends)>) -> Self {
        Gamepad { ends, ..Gamepad::default() }
    }

    /// Takes bytes, in pieces of any length.
    pub fn feed(&mut self, bytes: &[u8], events: &mut Vec<Event>) {
        self.rest.extend_from_slice(bytes);
        let whole: Vec<u8> = self.rest.drain(..self.rest.len() / EVENT * EVENT).collect();
        for event in whole.chunks_exact(EVENT) {
            let (kind, code) = (number(&event[16..18]) as u16, number(&event[18..20]) as u16);
            let value = i32::from_ne_bytes([event[20], event[21], event[22], event[23]]);
            self.take(kind, code, value, events);
        }
    }

    fn take(&mut self, kind: u16, code: u16, value: i32, events: &mut Vec<Event>) {
        match (kind, code) {
            (SYN, DROPPED) => {
                self.dropped = true;
                events.push(Event::Lost(Lost::Device(Device::Gamepad)));
            }
            (SYN, REPORT) => self.dropped = false,
            _ if self.dropped => {}
            (KEY, code) => {
                let button = Button::Of(Device::Gamepad, code);
                events.push(if value == 0 { Event::Release(button) } else { Event::Press(button) });
            }
            (ABS, code) => {
                let place = self.place(code, value);
                events.push(Event::Move(Axis(Device::Gamepad, code), place));
            }
            _ => {}
        }
    }

    /// Where an axis stands, beyond its dead zone.
    fn place(&mut self, code: u16, value: i32) -> f64 {
        let known = self.ends.iter().position(|(known, _)| *known == code);
        let at = known.unwrap_or_else(|| {
            self.ends.push((code, usual(code)));
            self.ends.len() - 1
        });
        let ends = &mut self.ends[at].1;
        if ends.rests_low && ends.high == 255 && value > 255 {
            ends.high = 1023;
        }
        let (low, high, value) = (f64::from(ends.low), f64::from(ends.high), f64::from(value));
        let place = (value - low) / (high - low).max(1.0);
        if ends.rests_low {
            rescaled(place.clamp(0.0, 1.0))
        } else {
            rescaled((2.0 * place - 1.0).clamp(-1.0, 1.0))
        }
    }
}

/// Zero in the dead zone, and from there on evenly to the ends.
fn rescaled(x: f64) -> f64 {
    x.signum() * ((x.abs() - DEAD) / (1.0 - DEAD)).max(0.0)
}

fn number(bytes: &[u8]) -> u32 {
    u32::from(u16::from_ne_bytes([bytes[0], bytes[1]]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(kind: u16, code: u16, value: i32) -> Vec<u8> {
        let time = [7_u64.to_ne_bytes(), 9_u64.to_ne_bytes()].concat();
        [&time[..], &kind.to_ne_bytes(), &code.to_ne_bytes(), &value.to_ne_bytes()].concat()
    }

    fn decoded(all: &[Vec<u8>]) -> Vec<Event> {
        let mut events = Vec::new();
        Gamepad::default().feed(&all.concat(), &mut events);
        events
    }

    fn moved(code: u16, place: f64) -> Event {
        Event::Move(Axis(Device::Gamepad, code), place)
    }

    #[test]
    fn sticks_triggers_hats_and_buttons_are_told() {
        let south = Button::Of(Device::Gamepad, 304);
        let events = decoded(&[
            bytes(ABS, 0, 32767),
            bytes(ABS, 1, -32768),
            bytes(ABS, 1, 3000),
            bytes(ABS, 2, 255),
            bytes(ABS, 5, 1023),
            bytes(ABS, 16, -1),
            bytes(KEY, 304, 1),
            bytes(SYN, REPORT, 0),
            bytes(KEY, 304, 0),
        ]);
        assert_eq!(
            events,
            [
                moved(0, 1.0),
                moved(1, -1.0),
                moved(1, 0.0),
                moved(2, 1.0),
                moved(5, 1.0),
                moved(16, -1.0),
                Event::Press(south),
                Event::Release(south)
            ]
        );
        // Half of the way that is left beyond the dead zone.
        let [Event::Move(_, half)] = decoded(&[bytes(ABS, 0, 18022)])[..] else { panic!() };
        assert!((half - 0.5).abs() < 1e-4, "{half}");
    }

    #[test]
    fn pieces_of_any_length_decode_alike() {
        let all = [bytes(ABS, 0, 20000), bytes(KEY, 307, 1), bytes(SYN, 0, 0), bytes(ABS, 4, -9000)].concat();
        let mut whole = Vec::new();
        Gamepad::default().feed(&all, &mut whole);
        assert_eq!(whole.len(), 3);
        for size in 1..60 {
            let (mut gamepad, mut events) = (Gamepad::default(), Vec::new());
            all.chunks(size).for_each(|piece| gamepad.feed(piece, &mut events));
            assert_eq!(events, whole, "{size}");
        }
    }

    #[test]
    fn dropped_events_release_everything() {
        let events =
            decoded(&[bytes(SYN, DROPPED, 0), bytes(KEY, 304, 1), bytes(SYN, REPORT, 0), bytes(KEY, 305, 1)]);
        let east = Button::Of(Device::Gamepad, 305);
        assert_eq!(events, [Event::Lost(Lost::Device(Device::Gamepad)), Event::Press(east)]);
    }
}
