//! Servos of any make, as a driver needs them: addresses and units of the registers in the control table, and packets that
//! read and write them. A make has a [`Family`] and [`Packets`].

use std::borrow::Cow;
use std::fmt;

/// How negative numbers are encoded in a control table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// There are no negative numbers.
    None,
    /// Two's complement.
    Complement,
    /// A magnitude, with this bit as its sign.
    Bit(u8),
}

/// A register: a number in a control table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// First byte.
    pub address: u16,
    /// Bytes: 1, 2 or 4, little-endian.
    pub size: u16,
    /// Encoding of negative numbers.
    pub sign: Sign,
}

impl Cell {
    /// A register that is never negative.
    pub const fn new(address: u16, size: u16) -> Cell {
        Cell { address, size, sign: Sign::None }
    }

    /// The same register with another encoding of negative numbers.
    #[must_use]
    pub const fn with_sign(self, sign: Sign) -> Cell {
        Cell { sign, ..self }
    }

    /// Decodes a number from its bytes, little-endian.
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

    /// Encodes a number, little-endian; the first `size` bytes are the register's. A magnitude beyond its range is clipped.
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

/// The quantity that a servo's command sets.
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

    /// Its name in configs.
    pub const fn name(self) -> &'static str {
        match self {
            Mode::Position => "position",
            Mode::Turns => "extended",
            Mode::Velocity => "velocity",
            Mode::Current => "current",
        }
    }
}

/// The value that a register must have for a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The register.
    pub cell: Cell,
    /// Smallest and largest accepted value.
    pub allowed: [i64; 2],
    /// The value that is written if the register has another.
    pub otherwise: i64,
}

impl Setting {
    /// A setting that accepts only this value.
    pub const fn exactly(cell: Cell, value: i64) -> Setting {
        Setting { cell, allowed: [value, value], otherwise: value }
    }
}

/// Describes the bits that are set in a register.
pub type Words = fn(u8) -> String;

/// The registers of a family of servos that a driver uses; `None` for those that the family lacks.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Number of the model.
    pub model: Cell,
    /// Version of the firmware.
    pub firmware: Option<Cell>,
    /// Delay before an answer, and its unit \[s\].
    pub return_delay: Option<(Cell, f64)>,
    /// Smallest and largest goal position.
    pub limits: [Cell; 2],
    /// 1 switches the torque on.
    pub torque: Cell,
    /// 0 allows writing of non-volatile registers.
    pub lock: Option<Cell>,
    /// The torque limit, which an alarm sets to 0, and the register with its initial value.
    pub torque_limit: Option<[Cell; 2]>,
    /// Watchdog of the bus, in units of 20 ms; 0 clears it.
    pub watchdog: Option<Cell>,
    /// Hardware errors, and their bits in words, where the error byte of an answer has only one bit for all of them.
    pub hardware_error: Option<(Cell, Words)>,
    /// The servo's own limit of velocity commands.
    pub velocity_limit: Option<Cell>,
    /// Acceleration limit of a motion to a goal position.
    pub acceleration: Option<Cell>,
    /// Velocity limit of a motion to a goal position; 0 for no limit.
    pub speed: Cell,
    /// Goal position.
    pub goal_position: Cell,
    /// Goal velocity.
    pub goal_velocity: Cell,
    /// Goal current.
    pub goal_current: Option<Cell>,
    /// Measured position. The measured quantities are close together, so that one request reads them.
    pub position: Cell,
    /// Measured velocity.
    pub velocity: Cell,
    /// Measured current.
    pub current: Option<Cell>,
}

impl Layout {
    /// The register with the goal of a mode.
    pub fn goal(&self, mode: Mode) -> Option<Cell> {
        match mode {
            Mode::Position | Mode::Turns => Some(self.goal_position),
            Mode::Velocity => Some(self.goal_velocity),
            Mode::Current => self.goal_current,
        }
    }

    /// Address and number of bytes of all measured quantities.
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
    /// Value of the register with the model.
    pub number: u16,
    /// One unit of position \[rad\].
    pub position: f64,
    /// The largest position within its turn.
    pub last: i64,
    /// One unit of velocity \[rad/s\].
    pub velocity: f64,
    /// One unit of acceleration \[rad/s²\].
    pub acceleration: f64,
    /// One unit of current \[A\]; `None` for servos that do not measure it.
    pub current: Option<f64>,
    /// Its modes, and the settings that each needs.
    pub modes: &'static [(Mode, &'static [Setting])],
    /// First firmware with the fast sync read, which reads all servos by one packet.
    pub fast_sync_read: Option<i64>,
}

/// The kinds of a static array of models.
macro_rules! kinds_of {
    ($models:ident) => {{
        let mut kinds = [$models[0].kind; $models.len()];
        let mut at = 0;
        while at < kinds.len() {
            kinds[at] = $models[at].kind;
            at += 1;
        }
        kinds
    }};
}
pub(crate) use kinds_of;

/// Servos with the same registers and packets.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Registers.
    pub layout: &'static Layout,
    /// Supported models.
    pub kinds: &'static [Kind],
    /// Whether one instruction reads several servos.
    pub sync_read: bool,
    /// Whether there is an instruction to restart, which clears hardware errors.
    pub reboots: bool,
    /// Creates the encoder and decoder of packets.
    pub packets: fn() -> Box<dyn Packets>,
}

/// A request to servos.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request<'a> {
    /// Reads one servo: address, number of bytes.
    Read(u16, u16),
    /// Writes to one servo: address, bytes.
    Write(u16, &'a [u8]),
    /// Restarts one servo; where [`Family::reboots`].
    Reboot,
    /// Reads the same bytes of several servos: address, number of bytes, ids; where [`Family::sync_read`].
    SyncRead(u16, u16, &'a [u8]),
    /// The same, answered by one packet; where [`Kind::fast_sync_read`] has the firmware.
    FastSyncRead(u16, u16, &'a [u8]),
    /// Writes to several servos: address, number of bytes, and for each servo its id and its bytes.
    SyncWrite(u16, u16, &'a [u8]),
}

/// An answer of a servo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer<'a> {
    /// The servo.
    pub id: u8,
    /// Error byte; 0 without an error.
    pub error: u8,
    /// Requested bytes.
    pub data: &'a [u8],
}

/// The meaning of an error byte.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// The instruction arrived damaged, and can be sent again.
    pub damaged: bool,
    /// Why the instruction was refused.
    pub refusal: Option<Cow<'static, str>>,
    /// Hardware errors.
    pub trouble: Option<Cow<'static, str>>,
}

/// Encodes requests and decodes answers.
pub trait Packets: Send {
    /// Largest number of bytes of an answer besides its data.
    fn frame(&self) -> usize;

    /// Appends a request to `out`: to the servo `id`, or to the servos that the request lists.
    ///
    /// # Errors
    /// A request that the protocol cannot express; `out` is then unchanged.
    fn encode(&mut self, out: &mut Vec<u8>, id: u8, request: Request<'_>) -> Result<(), RequestError>;

    /// Takes received bytes, and calls `take` with each complete answer, without the echo of `sent`, until it
    /// returns true; returns whether it did.
    fn answers(&mut self, sent: &[u8], came: &[u8], take: &mut dyn FnMut(Answer<'_>) -> bool) -> bool;

    /// Drops received bytes that are not yet an answer.
    fn clear(&mut self);

    /// The meaning of an error byte.
    fn verdict(&self, error: u8) -> Verdict;
}

/// Why a request cannot be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequestError {
    /// The protocol has no such instruction.
    Unknown,
    /// The request has more bytes than a packet, or a larger address.
    TooLong,
}

impl fmt::Display for RequestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RequestError::Unknown => "the servos' protocol has no instruction for the request",
            RequestError::TooLong => {
                "the request exceeds the size limit of a packet of this protocol; connect fewer servos to the bus"
            }
        })
    }
}

impl std::error::Error for RequestError {}

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
