//! What a person wants, in the bytes of a device.

use robohive_teleop::devices::Opened;
use robohive_teleop::{Device, Event, Keyboard};
use std::io::{Read, Write};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;

/// What a tick moves at most \[m, rad\], and the part of it with the key or button for a quarter.
pub const TICK: f64 = 0.05;
const TURN: f64 = 0.1;
const QUARTER: f64 = 0.25;

/// What a person wants during a tick: to move the hand \[m\], to turn it about z \[rad\], the gripper closed or open, and to be done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wish {
    pub by: [f64; 3],
    pub turn: f64,
    pub grip: Option<bool>,
    pub done: bool,
}

impl Wish {
    /// Parts of what a tick moves, and whether a quarter of it is enough.
    fn parts(&self) -> ([f64; 4], bool) {
        let [x, y, z] = self.by.map(|way| way / TICK);
        let parts = [x, y, z, self.turn / TURN];
        let slowly = parts.iter().all(|part| part.abs() < QUARTER);
        (if slowly { parts.map(|part| part / QUARTER) } else { parts }, slowly)
    }
}

/// The device that a person speaks by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speaker {
    /// Keys of a terminal that tells when they are released.
    Keys,
    /// Sticks and buttons of a pad.
    Pad,
}

/// Keys for less and more of an axis.
const KEYS: [[char; 2]; 4] = [['a', 'd'], ['x', 'w'], ['z', 'q'], [',', '.']];
/// Types of the events of a pad.
const KEY: u16 = 1;
const AXIS: u16 = 3;

impl Speaker {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Speaker::Keys => "keyboard",
            Speaker::Pad => "gamepad",
        }
    }

    /// The bytes of a wish: what is held during the tick, all else let go of. A key is down or not: what is `owed` is pressed later.
    fn bytes(self, wish: &Wish, owed: &mut [f64; 4]) -> Vec<u8> {
        let (parts, slowly) = wish.parts();
        let struck = [0, 1, 2, 3].map(|k| {
            let step = if slowly { QUARTER } else { 1.0 };
            owed[k] = (owed[k] + step * parts[k]).clamp(-1.0, 1.0);
            let strike = if owed[k].abs() >= step / 2.0 { owed[k].signum() } else { 0.0 };
            owed[k] -= step * strike;
            strike
        });
        match self {
            Speaker::Keys => keys(wish, struck, slowly),
            Speaker::Pad => pad(wish, [parts[0], parts[1], parts[2], struck[3]], slowly),
        }
    }
}

/// Keys in the protocol of kitty: code points, and 1 for a press or 3 for a release.
fn keys(wish: &Wish, struck: [f64; 4], slowly: bool) -> Vec<u8> {
    let mut out = String::new();
    let mut hold = |key: u32, held: bool| out += &format!("\u{1b}[{key};1:{}u", if held { 1 } else { 3 });
    for ([less, more], strike) in KEYS.into_iter().zip(struck) {
        hold(u32::from(less), strike < 0.0);
        hold(u32::from(more), strike > 0.0);
    }
    hold(u32::from('['), wish.grip == Some(true));
    hold(u32::from(']'), wish.grip == Some(false));
    hold(u32::from('v'), slowly);
    hold(13, wish.done);
    out.into_bytes()
}

/// Events of Linux: sticks from -32768 to 32767, triggers from 0 to 255, buttons 0 or 1.
fn pad(wish: &Wish, [x, y, z, turn]: [f64; 4], slowly: bool) -> Vec<u8> {
    let mut out = Vec::new();
    let mut event = |kind: u16, code: u16, value: i32| {
        out.extend([0; 16]);
        out.extend(kind.to_ne_bytes());
        out.extend(code.to_ne_bytes());
        out.extend(value.to_ne_bytes());
    };
    let stick = |part: f64| (part.clamp(-1.0, 1.0) * 32767.0) as i32;
    event(AXIS, 1, stick(x));
    event(AXIS, 0, stick(y));
    event(AXIS, 2, (z.clamp(0.0, 1.0) * 255.0) as i32);
    event(AXIS, 5, ((-z).clamp(0.0, 1.0) * 255.0) as i32);
    for (code, held) in [
        (310, turn > 0.0),
        (311, turn < 0.0),
        (308, wish.grip == Some(true)),
        (305, wish.grip == Some(false)),
        (307, slowly),
        (304, wish.done),
    ] {
        event(KEY, code, i32::from(held));
    }
    event(0, 0, 0);
    out
}

/// The two ends of a socket: a person at one, what reads a device at the other.
pub struct Line {
    speaker: Speaker,
    person: UnixStream,
    reader: Reader,
    /// Parts of a tick's motion that no key was pressed for yet.
    owed: [f64; 4],
}

enum Reader {
    Keys(Box<(UnixStream, Keyboard)>),
    Pad(Box<Opened>),
}

impl Line {
    /// A line of a device.
    pub fn new(speaker: Speaker) -> std::io::Result<Line> {
        let (person, device) = UnixStream::pair()?;
        device.set_nonblocking(true)?;
        let reader = match speaker {
            Speaker::Keys => Reader::Keys(Box::new((device, Keyboard::default()))),
            Speaker::Pad => Reader::Pad(Box::new(Opened::of(Device::Gamepad, OwnedFd::from(device)))),
        };
        Ok(Line { speaker, person, reader, owed: [0.0; 4] })
    }

    /// Says a wish at `now` \[s\], and reads what was said.
    pub fn say(&mut self, wish: &Wish, now: f64) -> Result<Vec<Event>, Box<dyn std::error::Error>> {
        self.person.write_all(&self.speaker.bytes(wish, &mut self.owed))?;
        let mut events = Vec::new();
        match &mut self.reader {
            Reader::Keys(keys) => {
                let mut bytes = [0; 4096];
                let count = keys.0.read(&mut bytes)?;
                keys.1.feed(&bytes[..count], now, &mut events);
            }
            Reader::Pad(pad) => pad.read(&mut events)?,
        }
        Ok(events)
    }
}
