//! Feetech servos of the STS series, as in the arms SO-100 and SO-101.
//!
//! Their packets are those of [Dynamixel's protocol 1.0](crate::dynamixel::v1), with a sync read. Numbers of 16 bits are
//! little-endian; those that can be negative have their sign in a bit of its own.
//!
//! Source: Feetech, "STS series communication protocol" and memory table of the STS3215, checked against the table of the
//! crate `rustypot`.

use crate::dynamixel::v1::PacketsV1;
use crate::servo::{Cell, Family, Kind, Layout, Mode, Setting, Sign, Verdict, words};

/// Value of the register "model" of an STS3215.
pub const STS3215: u16 = 777;
/// Steps of one turn.
pub const STEPS_PER_TURN: f64 = 4096.0;
/// One step of position \[rad\], and one unit of velocity \[rad/s\].
pub const STEP: f64 = std::f64::consts::TAU / STEPS_PER_TURN;
/// One unit of acceleration \[rad/s²\]: 100 steps.
pub const ACCELERATION_UNIT: f64 = 100.0 * STEP;
/// One unit of current \[A\].
pub const CURRENT_UNIT: f64 = 6.5e-3;
/// Bytes of the memory table.
pub const TABLE: usize = 88;

/// Bits of the error byte, and of the register "status".
pub mod trouble {
    #![allow(missing_docs)]
    pub const VOLTAGE: u8 = 1;
    pub const SENSOR: u8 = 2;
    pub const HEAT: u8 = 4;
    pub const CURRENT: u8 = 8;
    pub const OVERLOAD: u8 = 32;

    const NAMES: [(u8, &str); 5] = [
        (VOLTAGE, "voltage"),
        (SENSOR, "position sensor"),
        (HEAT, "overheating"),
        (CURRENT, "too much current"),
        (OVERLOAD, "overload"),
    ];

    /// The meaning of the bits, all of which are hardware errors.
    pub fn verdict(error: u8) -> super::Verdict {
        let trouble = (error != 0).then(|| super::words(&NAMES, error).into());
        super::Verdict { trouble, ..super::Verdict::default() }
    }
}

/// Addresses of the memory table.
pub mod address {
    #![allow(missing_docs)]
    pub const MODEL: u8 = 3;
    pub const ID: u8 = 5;
    pub const BAUD_RATE: u8 = 6;
    pub const RETURN_DELAY: u8 = 7;
    pub const MIN_ANGLE: u8 = 9;
    pub const MAX_ANGLE: u8 = 11;
    pub const MAX_TEMPERATURE: u8 = 13;
    pub const MAX_TORQUE: u8 = 16;
    pub const OFFSET: u8 = 31;
    pub const MODE: u8 = 33;
    pub const TORQUE_ENABLE: u8 = 40;
    pub const ACCELERATION: u8 = 41;
    pub const GOAL_POSITION: u8 = 42;
    pub const GOAL_TIME: u8 = 44;
    pub const GOAL_VELOCITY: u8 = 46;
    pub const TORQUE_LIMIT: u8 = 48;
    /// Registers below [`TORQUE_ENABLE`] are non-volatile, and can be written only while this is 0.
    pub const LOCK: u8 = 55;
    pub const PRESENT_POSITION: u8 = 56;
    pub const PRESENT_VELOCITY: u8 = 58;
    pub const PRESENT_LOAD: u8 = 60;
    pub const PRESENT_VOLTAGE: u8 = 62;
    pub const PRESENT_TEMPERATURE: u8 = 63;
    pub const STATUS: u8 = 65;
    pub const MOVING: u8 = 66;
    pub const PRESENT_CURRENT: u8 = 69;
}

const fn signed(address: u8) -> Cell {
    Cell::new(address as u16, 2).with_sign(Sign::Bit(15))
}

const MODE: Cell = Cell::new(address::MODE as u16, 1);

/// Registers that drivers use.
const LAYOUT: Layout = Layout {
    model: Cell::new(address::MODEL as u16, 2),
    firmware: None,
    return_delay: None,
    limits: [Cell::new(address::MIN_ANGLE as u16, 2), Cell::new(address::MAX_ANGLE as u16, 2)],
    torque: Cell::new(address::TORQUE_ENABLE as u16, 1),
    lock: Some(Cell::new(address::LOCK as u16, 1)),
    torque_limit: None,
    watchdog: None,
    hardware_error: None,
    velocity_limit: None,
    acceleration: Some(Cell::new(address::ACCELERATION as u16, 1)),
    speed: signed(address::GOAL_VELOCITY),
    goal_position: signed(address::GOAL_POSITION),
    goal_velocity: signed(address::GOAL_VELOCITY),
    goal_current: None,
    position: signed(address::PRESENT_POSITION),
    velocity: signed(address::PRESENT_VELOCITY),
    current: Some(Cell::new(address::PRESENT_CURRENT as u16, 2)),
};

/// Supported models, for drivers.
pub static KINDS: [Kind; 1] = [Kind {
    name: "STS3215",
    number: STS3215,
    position: STEP,
    last: 4095,
    velocity: STEP,
    acceleration: ACCELERATION_UNIT,
    current: Some(CURRENT_UNIT),
    modes: &[(Mode::Position, &[Setting::exactly(MODE, 0)]), (Mode::Velocity, &[Setting::exactly(MODE, 1)])],
    fast_sync_read: None,
}];

/// Servos of the STS series, for drivers.
pub static FAMILY: Family = Family {
    layout: &LAYOUT,
    kinds: &KINDS,
    sync_read: true,
    reboots: false,
    packets: || Box::new(PacketsV1::new(trouble::verdict)),
};
