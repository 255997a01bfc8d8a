//! What a driver must know of servos of any make: where the numbers of a control table stand, in which units, and how packets
//! ask for them. A make is a [`Family`] and its [`Packets`].

use std::borrow::Cow;

/// How a negative number stands in a control table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Not at all.
    None,
    /// As two's complement.
    Complement,
    /// As a magnitude, with this bit set.
    Bit(u8),
}

/// A number of a control table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// First byte.
    pub address: u16,
    /// Bytes: 1, 2 or 4, little-endian.
    pub size: u16,
    /// How negative ones are written.
    pub sign: Sign,
}

impl Cell {
    /// A number that is never negative.
    pub const fn new(address: u16, size: u16) -> Cell {
        Cell { address, size, sign: Sign::None }
    }

    /// The same place with another sign.
    #[must_use]
    pub const fn with_sign(self, sign: Sign) -> Cell {
        Cell { sign, ..self }
    }

    /// The number that these bytes, of which the last ones count most, are.
    ///
    /// ```
    /// use robohive_protocol::servo::{Cell, Sign};
    ///
    /// let speed = Cell::new(38, 2).with_sign(Sign::Bit(10));
    /// assert_eq!(speed.decode(&[0x05, 0x04]), -5);
    /// assert_eq!(speed.encode(-5), [0x05, 0x04, 0, 0]);
    /// ```
    pub fn decode(self, bytes: &[u8]) -> i64 {
        let raw = bytes.iter().rev().fold(0_i64, |number, byte| number << 8 | i64::from(*byte));
        match self.sign {
            Sign::None => raw,
            Sign::Complement => {
                let unused = 64 - 8 * bytes.len().clamp(1, 8) as u32;
                raw << unused >> unused
            }
            Sign::Bit(bit) => {
                let magnitude = raw & ((1 << bit) - 1);
                if raw >> bit & 1 == 1 { -magnitude } else { magnitude }
            }
        }
    }

    /// The bytes of a number, of which the first `size` count; a magnitude that is too large is clipped.
    pub fn encode(self, value: i64) -> [u8; 4] {
        let raw = match self.sign {
            Sign::Bit(bit) => {
                let magnitude = value.abs().min((1 << bit) - 1);
                if value < 0 { magnitude | 1 << bit } else { magnitude }
            }
            Sign::None => value.clamp(0, (1 << (8 * self.size)) - 1),
            Sign::Complement => {
                let end = 1 << (8 * self.size - 1);
                value.clamp(-end, end - 1)
            }
        };
        (raw as u32).to_le_bytes()
    }
}

/// What a servo is commanded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// A position within one turn.
    Position,
    /// A position over several turns.
    Turns,
    /// A velocity.
    Velocity,
    /// A current.
    Current,
}

impl Mode {
    /// All of them.
    pub const ALL: [Mode; 4] = [Mode::Position, Mode::Turns, Mode::Velocity, Mode::Current];

    /// What configs call it.
    pub const fn name(self) -> &'static str {
        match self {
            Mode::Position => "position",
            Mode::Turns => "extended",
            Mode::Velocity => "velocity",
            Mode::Current => "current",
        }
    }
}

/// A register that must hold one of some numbers before a servo is commanded in a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The register.
    pub cell: Cell,
    /// Smallest and largest number that will do.
    pub allowed: [i64; 2],
    /// What is written where it holds none of these.
    pub otherwise: i64,
}

impl Setting {
    /// One number alone will do.
    pub const fn exactly(cell: Cell, value: i64) -> Setting {
        Setting { cell, allowed: [value, value], otherwise: value }
    }
}

/// Where servos of a family have what a driver uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Number of the model.
    pub model: Cell,
    /// Version of the firmware.
    pub firmware: Option<Cell>,
    /// Delay before an answer, and the time of one unit \[s\].
    pub return_delay: Option<(Cell, f64)>,
    /// Smallest and largest goal position.
    pub limits: [Cell; 2],
    /// 1: the motor has torque.
    pub torque: Cell,
    /// 0: what outlives a restart may be written.
    pub lock: Option<Cell>,
    /// The limit of torque, which an alarm makes 0, and what it was before.
    pub torque_limit: Option<[Cell; 2]>,
    /// Watchdog of the bus, in units of 20 ms; 0 clears it.
    pub watchdog: Option<Cell>,
    /// What the hardware has, where the error byte of an answer says no more than that it has something.
    pub hardware_error: Option<Cell>,
    /// Largest velocity that the servo lets itself be commanded.
    pub velocity_limit: Option<Cell>,
    /// Limit of the acceleration on the way to a goal position.
    pub acceleration: Option<Cell>,
    /// Limit of the velocity on the way to a goal position; 0 is none.
    pub speed: Cell,
    /// Goals.
    pub goal_position: Cell,
    /// Of modes with a velocity.
    pub goal_velocity: Cell,
    /// Of modes with a current.
    pub goal_current: Option<Cell>,
    /// What is measured, close together.
    pub position: Cell,
    /// The velocity.
    pub velocity: Cell,
    /// The current, where it is measured.
    pub current: Option<Cell>,
}

impl Layout {
    /// Where the goal of a mode is written.
    pub fn goal(&self, mode: Mode) -> Option<Cell> {
        match mode {
            Mode::Position | Mode::Turns => Some(self.goal_position),
            Mode::Velocity => Some(self.goal_velocity),
            Mode::Current => self.goal_current,
        }
    }

    /// First byte and number of bytes of all that is measured.
    pub fn present(&self) -> (u16, u16) {
        let cells = [Some(self.position), Some(self.velocity), self.current];
        let cells = cells.into_iter().flatten();
        let from = cells.clone().map(|cell| cell.address).min().unwrap_or(0);
        (from, cells.map(|cell| cell.address + cell.size).max().unwrap_or(0) - from)
    }
}

/// A model of servo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// What the register of the model says.
    pub number: u16,
    /// One unit of position \[rad\].
    pub position: f64,
    /// The largest position within its turn.
    pub last: i64,
    /// One unit of velocity \[rad/s\].
    pub velocity: f64,
    /// One unit of acceleration \[rad/s²\].
    pub acceleration: f64,
    /// One unit of current \[A\], of those that measure it.
    pub current: Option<f64>,
    /// What it can be commanded, and what it needs for that.
    pub modes: &'static [(Mode, &'static [Setting])],
    /// The firmware from which on all can be read by one packet.
    pub fast_sync_read: Option<i64>,
}

/// Servos that share a layout and a kind of packets.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Where what is.
    pub layout: &'static Layout,
    /// Models that are known.
    pub kinds: &'static [Kind],
    /// Whether one instruction reads several servos.
    pub sync_read: bool,
    /// Whether a restart can be asked for, which clears errors of the hardware.
    pub reboots: bool,
    /// Makes what turns requests into bytes.
    pub packets: fn() -> Box<dyn Packets>,
}

/// What servos are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request<'a> {
    /// Bytes of one: the first one's address, and how many.
    Read(u16, u16),
    /// Bytes for one, from an address on.
    Write(u16, &'a [u8]),
    /// A restart.
    Reboot,
    /// The same bytes of several: address, count, ids.
    SyncRead(u16, u16, &'a [u8]),
    /// The same in one packet.
    FastSyncRead(u16, u16, &'a [u8]),
    /// Bytes for several: address, count, and for each its id and its bytes.
    SyncWrite(u16, u16, &'a [u8]),
}

/// What a servo says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer<'a> {
    /// Who.
    pub id: u8,
    /// What is wrong.
    pub error: u8,
    /// What was asked for.
    pub data: &'a [u8],
}

/// What an error byte means.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// The instruction came damaged: it may be sent again.
    pub damaged: bool,
    /// Why the instruction was not followed.
    pub refusal: Option<Cow<'static, str>>,
    /// What the hardware has.
    pub trouble: Option<Cow<'static, str>>,
}

/// Requests as bytes, and bytes as answers.
pub trait Packets: Send {
    /// Bytes of an answer around its data, at most.
    fn frame(&self) -> usize;

    /// Appends a request to the servo `id`, or to all that it names.
    fn encode(&mut self, out: &mut Vec<u8>, id: u8, request: Request<'_>);

    /// Takes bytes, and gives the answers among all that came, without the echo of what was `sent`, to `take` until that
    /// returns true; returns whether it did.
    fn answers(&mut self, sent: &[u8], came: &[u8], take: &mut dyn FnMut(Answer<'_>) -> bool) -> bool;

    /// Drops what came and was no answer yet.
    fn clear(&mut self);

    /// What an error byte means.
    fn verdict(&self, error: u8) -> Verdict;

    /// The register "hardware error" in words.
    fn describe_trouble(&self, bits: u8) -> String;
}

/// Names of bits that are set.
pub(crate) fn words(names: &[(u8, &str)], bits: u8) -> String {
    let words: Vec<_> = names.iter().filter(|(bit, _)| bits & bit != 0).map(|(_, word)| *word).collect();
    if words.is_empty() { format!("unknown ({bits:#04x})") } else { words.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_from_their_bytes() {
        for (sign, largest) in [(Sign::Complement, 32_767), (Sign::Bit(15), 32_767), (Sign::Bit(10), 1023)] {
            let cell = Cell::new(0, 2).with_sign(sign);
            for value in [0, 1, -1, 500, -500, largest, -largest] {
                assert_eq!(cell.decode(&cell.encode(value)[..2]), value, "{sign:?}");
            }
        }
        let cell = Cell::new(0, 2).with_sign(Sign::Bit(15));
        assert_eq!((cell.encode(-2), cell.encode(-100_000)), ([2, 0x80, 0, 0], [0xFF, 0xFF, 0, 0]));
        // What is beyond a register is its end, and not the other direction.
        for (cell, value, kept) in [
            (Cell::new(0, 2).with_sign(Sign::Complement), 40_000, 32_767),
            (Cell::new(0, 4).with_sign(Sign::Complement), i64::MIN, -2_147_483_648),
            (Cell::new(0, 1), 300, 255),
            (Cell::new(0, 2), -1, 0),
        ] {
            assert_eq!(cell.decode(&cell.encode(value)[..usize::from(cell.size)]), kept);
        }
        assert_eq!(Cell::new(0, 1).decode(&[0xFF]), 255);
        assert_eq!(Cell::new(0, 4).with_sign(Sign::Complement).decode(&[0xFE, 0xFF, 0xFF, 0xFF]), -2);
    }
}
