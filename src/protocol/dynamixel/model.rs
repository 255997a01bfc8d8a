//! Models of servos with protocol 2.0.

use super::registers::{Register, TABLE, address};
use crate::servo::{self, Cell, Kind, Setting, kinds_of};

/// Positions of one turn of the output shaft.
pub const POSITION_PER_TURN: f64 = 4096.0;

/// Bits of the register "Hardware Error Status".
pub mod hardware_error {
    #![allow(missing_docs)]
    pub const VOLTAGE: u8 = 1;
    pub const HALL_SENSOR: u8 = 2;
    pub const HEAT: u8 = 4;
    pub const ENCODER: u8 = 8;
    pub const ELECTRICAL: u8 = 16;
    pub const OVERLOAD: u8 = 32;

    const NAMES: [(u8, &str); 6] = [
        (VOLTAGE, "input voltage out of range"),
        (HALL_SENSOR, "motor's Hall sensor"),
        (HEAT, "overheating"),
        (ENCODER, "encoder"),
        (ELECTRICAL, "electrical shock"),
        (OVERLOAD, "overload"),
    ];

    /// The bits in words.
    pub fn describe(bits: u8) -> String {
        crate::servo::words(&NAMES, bits)
    }
}

/// Values of the register "Operating Mode".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Mode {
    /// Goal current.
    Current = 0,
    /// Goal velocity.
    Velocity = 1,
    /// Goal position within one turn.
    Position = 3,
    /// Goal position over 256 turns each way.
    ExtendedPosition = 4,
    /// Goal position with the goal current as its limit.
    CurrentPosition = 5,
    /// Goal PWM.
    Pwm = 16,
}

impl Mode {
    /// The mode of a register's value.
    pub fn of(value: u8) -> Option<Mode> {
        [
            Mode::Current,
            Mode::Velocity,
            Mode::Position,
            Mode::ExtendedPosition,
            Mode::CurrentPosition,
            Mode::Pwm,
        ]
        .into_iter()
        .find(|mode| *mode as u8 == value)
    }
}

/// A model of servo with protocol 2.0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    /// Properties for drivers. The unit of current is `None` where the servo measures load (0.1 % of the largest torque) instead.
    pub kind: Kind,
    /// Modes.
    pub modes: &'static [Mode],
    /// Stall torque \[N m\] and stall current \[A\] at the nominal voltage.
    pub stall: [f64; 2],
    /// Registers whose value after a factory reset differs from that of the XM430-W350.
    initial: &'static [(u16, i64)],
}

const ALL_MODES: &[Mode] = &[
    Mode::Current,
    Mode::Velocity,
    Mode::Position,
    Mode::ExtendedPosition,
    Mode::CurrentPosition,
    Mode::Pwm,
];
const WITHOUT_CURRENT: &[Mode] = &[Mode::Velocity, Mode::Position, Mode::ExtendedPosition, Mode::Pwm];

const fn mode(mode: Mode) -> [Setting; 1] {
    [Setting::exactly(Cell::new(address::OPERATING_MODE, 1), mode as i64)]
}

const POSITION: (servo::Mode, &[Setting]) = (servo::Mode::Position, &mode(Mode::Position));
const TURNS: (servo::Mode, &[Setting]) = (servo::Mode::Turns, &mode(Mode::ExtendedPosition));
const VELOCITY: (servo::Mode, &[Setting]) = (servo::Mode::Velocity, &mode(Mode::Velocity));
const CURRENT: (servo::Mode, &[Setting]) = (servo::Mode::Current, &mode(Mode::Current));

/// A model with its name, number, unit of current \[A\], stall torque \[N m\] and current \[A\], and first firmware with the fast
/// sync read.
const fn servo(
    name: &'static str,
    number: u16,
    current: Option<f64>,
    stall: [f64; 2],
    fast_sync_read: Option<i64>,
) -> Model {
    let (modes, commanded): (&[Mode], &[(servo::Mode, &[Setting])]) = match current {
        Some(_) => (ALL_MODES, &[POSITION, TURNS, VELOCITY, CURRENT]),
        None => (WITHOUT_CURRENT, &[POSITION, TURNS, VELOCITY]),
    };
    let kind = Kind {
        name,
        number,
        position: Model::POSITION_UNIT,
        last: 4095,
        velocity: Model::VELOCITY_UNIT,
        acceleration: Model::ACCELERATION_UNIT,
        current,
        modes: commanded,
        fast_sync_read,
    };
    Model { kind, modes, stall, initial: &[] }
}

/// Supported models; source: the page of each in the ROBOTIS e-Manual.
pub static MODELS: [Model; 7] = [
    servo("XM430-W350", 1020, Some(2.69e-3), [4.1, 2.3], Some(45)),
    Model { initial: XL430, ..servo("XL430-W250", 1060, None, [1.5, 1.4], Some(45)) },
    Model { initial: XL330, ..servo("XL330-M288", 1200, Some(1e-3), [0.52, 1.47], Some(46)) },
    Model { initial: XL330, ..servo("XL330-M077", 1190, Some(1e-3), [0.215, 1.47], Some(46)) },
    servo("MX-28(2.0)", 30, None, [2.5, 1.4], None),
    servo("MX-64(2.0)", 311, Some(3.36e-3), [6.0, 4.1], None),
    servo("MX-106(2.0)", 321, Some(3.36e-3), [8.4, 5.2], None),
];

/// Properties of the supported models, for drivers.
pub static KINDS: [Kind; MODELS.len()] = kinds_of!(MODELS);

const XL430: &[(u16, i64)] = &[
    (34, 65),
    (32, 120),
    (address::TEMPERATURE_LIMIT, 72),
    (address::VELOCITY_LIMIT, 265),
    (84, 640),
    (80, 4000),
];

const XL330: &[(u16, i64)] = &[
    (32, 70),
    (34, 35),
    (address::TEMPERATURE_LIMIT, 70),
    (address::CURRENT_LIMIT, 1750),
    (address::VELOCITY_LIMIT, 445),
    (address::SHUTDOWN, 53),
    (84, 400),
    (address::PRESENT_VOLTAGE, 50),
];

/// The model of this name.
pub fn model(name: &str) -> Option<&'static Model> {
    MODELS.iter().find(|model| model.kind.name == name)
}

impl Model {
    /// One unit of velocity \[rad/s\]: 0.229 turns a minute.
    pub const VELOCITY_UNIT: f64 = 0.229 / 60.0 * std::f64::consts::TAU;
    /// One unit of "Profile Acceleration" \[rad/s²\]: 214.577 turns a minute, each minute.
    pub const ACCELERATION_UNIT: f64 = 214.577 / 3600.0 * std::f64::consts::TAU;
    /// One unit of position \[rad\].
    pub const POSITION_UNIT: f64 = std::f64::consts::TAU / POSITION_PER_TURN;
    /// One unit of "Return Delay Time" \[s\].
    pub const DELAY_UNIT: f64 = 2e-6;
    /// One unit of "Bus Watchdog" \[s\].
    pub const WATCHDOG_UNIT: f64 = 0.02;

    /// Torque constant \[N m/A\]: stall torque over stall current.
    pub fn torque_constant(&self) -> f64 {
        self.stall[0] / self.stall[1]
    }

    /// Its registers, sorted by address.
    pub fn registers(&self) -> impl Iterator<Item = Register> + '_ {
        TABLE.into_iter().map(|register| {
            let own = self.initial.iter().find(|(address, _)| *address == register.address);
            let initial = match register.address {
                address::MODEL_NUMBER => i64::from(self.kind.number),
                _ => own.map_or(register.initial, |(_, value)| *value),
            };
            Register { initial, ..register }
        })
    }

    /// The register that contains the byte at this address.
    pub fn register(&self, address: u16) -> Option<Register> {
        self.registers().find(|r| (r.address..r.address + r.size).contains(&address))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_do_not_overlap_and_their_values_fit() {
        for model in &MODELS {
            let mut end = 0;
            for register in model.registers() {
                assert!(register.address >= end, "{} of {}", register.name, model.kind.name);
                end = register.address + register.size;
                let [low, high] = register.range;
                assert!((low..=high).contains(&register.initial), "{} of {}", register.name, model.kind.name);
            }
            assert!(end <= address::INDIRECT_ADDRESS);
            assert!(
                model.initial.iter().all(|(at, _)| model.register(*at).is_some_and(|r| r.address == *at))
            );
        }
    }
}
