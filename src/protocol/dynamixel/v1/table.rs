//! The control table of servos with protocol 1.0, and their models.

use super::packet::{PacketsV1, error};
use crate::servo::{Cell, Family, Kind, Layout, Mode, Setting, Sign, kinds_of};
use std::f64::consts::TAU;

/// Addresses of the control table.
pub mod address {
    #![allow(missing_docs)]
    pub const MODEL_NUMBER: u16 = 0;
    pub const FIRMWARE: u16 = 2;
    pub const ID: u16 = 3;
    pub const BAUD_RATE: u16 = 4;
    pub const RETURN_DELAY: u16 = 5;
    pub const CW_LIMIT: u16 = 6;
    pub const CCW_LIMIT: u16 = 8;
    pub const TEMPERATURE_LIMIT: u16 = 11;
    pub const MIN_VOLTAGE: u16 = 12;
    pub const MAX_VOLTAGE: u16 = 13;
    pub const MAX_TORQUE: u16 = 14;
    pub const STATUS_RETURN: u16 = 16;
    pub const ALARM_LED: u16 = 17;
    pub const SHUTDOWN: u16 = 18;
    /// Registers below it are non-volatile, and are locked while torque is on.
    pub const TORQUE_ENABLE: u16 = 24;
    pub const GOAL_POSITION: u16 = 30;
    pub const MOVING_SPEED: u16 = 32;
    pub const TORQUE_LIMIT: u16 = 34;
    pub const PRESENT_POSITION: u16 = 36;
    pub const PRESENT_SPEED: u16 = 38;
    pub const PRESENT_LOAD: u16 = 40;
    pub const PRESENT_VOLTAGE: u16 = 42;
    pub const PRESENT_TEMPERATURE: u16 = 43;
    pub const REGISTERED: u16 = 44;
    pub const MOVING: u16 = 46;
    /// 1 locks the non-volatile registers until the next restart.
    pub const LOCK: u16 = 47;
    pub const PUNCH: u16 = 48;
}

/// Bytes of the table.
pub const TABLE: usize = 50;

const CW_LIMIT: Cell = Cell::new(address::CW_LIMIT, 2);
const CCW_LIMIT: Cell = Cell::new(address::CCW_LIMIT, 2);
const TORQUE_LIMIT: Cell = Cell::new(address::TORQUE_LIMIT, 2);
const SPEED: Cell = Cell::new(address::MOVING_SPEED, 2).with_sign(Sign::Bit(10));

/// Registers that drivers use.
const LAYOUT: Layout = Layout {
    model: Cell::new(address::MODEL_NUMBER, 2),
    firmware: None,
    return_delay: Some((Cell::new(address::RETURN_DELAY, 1), Model::DELAY_UNIT)),
    limits: [CW_LIMIT, CCW_LIMIT],
    torque: Cell::new(address::TORQUE_ENABLE, 1),
    lock: None,
    torque_limit: Some([TORQUE_LIMIT, Cell::new(address::MAX_TORQUE, 2)]),
    watchdog: None,
    hardware_error: None,
    velocity_limit: None,
    acceleration: None,
    speed: SPEED,
    goal_position: Cell::new(address::GOAL_POSITION, 2),
    goal_velocity: SPEED,
    goal_current: None,
    position: Cell::new(address::PRESENT_POSITION, 2),
    velocity: Cell::new(address::PRESENT_SPEED, 2).with_sign(Sign::Bit(10)),
    current: None,
};

/// A model of servo with protocol 1.0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    /// Properties for drivers.
    pub kind: Kind,
    /// Stall torque at the nominal voltage \[N m\].
    pub stall: f64,
    /// Whether it has an encoder. Then its wheel mode controls the velocity, where that of others sets a share of the
    /// output, and it supports the bulk read of several servos.
    pub encoder: bool,
}

impl Model {
    /// One unit of the return delay \[s\].
    pub const DELAY_UNIT: f64 = 2e-6;
}

/// The angle limits select the mode: both at 0 is wheel mode, both at the largest value multi-turn mode, all others position mode.
const POSITION_300: &[Setting] = &[Setting { cell: CCW_LIMIT, allowed: [1, 1023], otherwise: 1023 }];
const POSITION_360: &[Setting] = &[
    Setting { cell: CW_LIMIT, allowed: [0, 4094], otherwise: 0 },
    Setting { cell: CCW_LIMIT, allowed: [1, 4095], otherwise: 4095 },
];
const WHEEL: &[Setting] = &[Setting::exactly(CW_LIMIT, 0), Setting::exactly(CCW_LIMIT, 0)];

/// Servos with a potentiometer: 1024 positions over 300 degrees, 512 in the middle. Their wheel mode sets the output, not
/// the velocity, so drivers do not use it.
const fn potentiometer(name: &'static str, number: u16, stall: f64) -> Model {
    let kind = Kind {
        name,
        number,
        position: TAU * 300.0 / 360.0 / 1024.0,
        last: 1023,
        velocity: 0.111 / 60.0 * TAU,
        acceleration: f64::INFINITY,
        current: None,
        modes: &[(Mode::Position, POSITION_300)],
        fast_sync_read: None,
    };
    Model { kind, stall, encoder: false }
}

/// Servos with an encoder: 4096 positions over a turn.
const fn encoder(name: &'static str, number: u16, stall: f64) -> Model {
    let kind = Kind {
        position: TAU / 4096.0,
        last: 4095,
        velocity: 0.114 / 60.0 * TAU,
        modes: &[(Mode::Position, POSITION_360), (Mode::Velocity, WHEEL)],
        ..potentiometer(name, number, stall).kind
    };
    Model { kind, stall, encoder: true }
}

/// Supported models; source: the page of each in the ROBOTIS e-Manual.
pub static MODELS: [Model; 8] = [
    potentiometer("AX-12A", 12, 1.5),
    potentiometer("AX-18A", 18, 1.8),
    potentiometer("RX-24F", 24, 2.6),
    potentiometer("RX-28", 28, 3.7),
    potentiometer("RX-64", 64, 5.3),
    encoder("MX-28", 29, 2.5),
    encoder("MX-64", 310, 6.0),
    encoder("MX-106", 320, 8.4),
];

/// Properties of the supported models, for drivers.
pub static KINDS: [Kind; MODELS.len()] = kinds_of!(MODELS);

/// Servos with protocol 1.0, for drivers.
pub static FAMILY: Family = Family {
    layout: &LAYOUT,
    kinds: &KINDS,
    sync_read: false,
    reboots: false,
    packets: || Box::new(PacketsV1::new(error::verdict)),
};

/// The model of this name.
pub fn model(name: &str) -> Option<&'static Model> {
    MODELS.iter().find(|model| model.kind.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_measured_is_read_at_once() {
        // Position and speed, 4 bytes from 36 on.
        assert_eq!(LAYOUT.present(), (36, 4));
        let kind = model("AX-12A").unwrap().kind;
        assert!(((512.0 * kind.position).to_degrees() - 150.0).abs() < 1e-12);
        assert_eq!(LAYOUT.goal(Mode::Current), None);
    }
}
