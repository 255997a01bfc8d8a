//! The driver of a bus of servos.

use super::bus::Bus;
use super::settings::{Motor, Settings};
use crate::driver::Driver;
use crate::port::Opener;
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use crate::servos::{Quantity, Safe};
use protocol::dynamixel::{MODELS, Mode, Model, address, model};
use robot::{DeviceConfig, Fault};

/// Bus watchdog of the servos, in units of 20 ms.
const BUS_WATCHDOG: i64 = 5;
/// Without a reading for this long the servos are made safe \[s\]: three lost answers, each with the wait for it.
const READING: f64 = 0.09;
/// Time between two readings of servos that nobody else reads \[s\].
const HEARTBEAT: f64 = 0.02;
/// Seconds of silence after a reboot, with some to spare.
const REBOOT: f64 = 0.4;
/// First register of what is read in every period: current, velocity, position.
const PRESENT: u16 = address::PRESENT_CURRENT;
/// Bytes from there on.
const PRESENT_SIZE: u16 = 10;
/// One turn \[rad\].
const TURN: f64 = std::f64::consts::TAU;

/// What a servo last said.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    current: i16,
    velocity: i32,
    position: i32,
}

/// Servos on a serial bus, see [the module](super).
pub struct Dynamixel {
    settings: Settings,
    opener: Opener,
    bus: Option<Bus>,
    ids: Vec<u8>,
    models: Vec<&'static Model>,
    states: Vec<State>,
    scratch: Vec<u8>,
}

impl Dynamixel {
    /// The driver of a device; nothing is opened yet.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub fn new(config: &DeviceConfig, opener: Opener) -> Result<Dynamixel, Fault> {
        let settings = Settings::new(config)?;
        let ids = settings.ids();
        Ok(Dynamixel {
            opener,
            bus: None,
            models: vec![&MODELS[0]; ids.len()],
            states: vec![State::default(); ids.len()],
            scratch: Vec::with_capacity(8 * ids.len()),
            ids,
            settings,
        })
    }

    fn bus(&mut self) -> Result<&mut Bus, Fault> {
        self.bus.as_mut().ok_or(Fault::NotConnected)
    }

    fn place(&self, id: u8) -> usize {
        self.ids.iter().position(|other| *other == id).unwrap_or(0)
    }

    /// Finds every servo, and reboots those whose hardware has an error.
    fn find(&mut self) -> Result<(), Fault> {
        for place in 0..self.ids.len() {
            let id = self.ids[place];
            let (port, baud) = (self.settings.port.clone(), self.settings.baud);
            let bus = self.bus()?;
            let missing = |fault| match fault {
                Fault::Stale(_) => Fault::Unreachable(format!(
                    "servo {id} does not answer at {baud} baud on {port}; check its power, its id and its baud rate"
                )),
                other => other,
            };
            let (number, _, answer) = bus.ping(id).map_err(missing)?;
            if answer.alert {
                bus.reboot(id)?;
                bus.wait(REBOOT);
                if bus.ping(id)?.2.alert {
                    let trouble = bus.trouble(id)?;
                    return Err(Fault::Refused(format!("servo {id} reports {trouble}, also after a reboot")));
                }
            }
            self.models[place] = model(number).ok_or_else(|| {
                let known: Vec<_> = MODELS.iter().map(|model| model.name).collect();
                Fault::Refused(format!("servo {id} is of model {number}; known are {}", known.join(", ")))
            })?;
        }
        Ok(())
    }

    /// Sets what a servo needs before it gets torque: mode, answers, profile.
    fn prepare(&mut self, motor: Motor) -> Result<(), Fault> {
        let Motor { id, mode, .. } = motor;
        let model = self.models[self.place(id)];
        if !model.modes.contains(&mode) {
            return Err(Fault::Refused(format!("servo {id}, an {}, has no mode '{mode:?}'", model.name)));
        }
        let delay = (self.settings.return_delay * 1e-6 / Model::DELAY_UNIT) as i64;
        let acceleration = self.settings.profile_acceleration / Model::ACCELERATION_UNIT;
        let velocity = self.settings.profile_velocity;
        let bus = self.bus()?;
        bus.write(id, address::BUS_WATCHDOG, 1, 0)?;
        for (register, size, value) in
            [(address::RETURN_DELAY, 1, delay), (address::OPERATING_MODE, 1, mode as i64)]
        {
            // These outlive a reboot in memory that wears, and take the torque away: written only where they differ.
            // Answers carry no number: one that is late can be taken for another, so that two must agree.
            if bus.read(id, register, size)? != value && bus.read(id, register, size)? != value {
                bus.write(id, address::TORQUE_ENABLE, 1, 0)?;
                bus.write(id, register, size, value)?;
            }
        }
        let velocity = match velocity {
            Some(velocity) => (velocity / Model::VELOCITY_UNIT).round() as i64,
            None => bus.read(id, address::VELOCITY_LIMIT, 4)?,
        };
        bus.write(id, address::PROFILE_ACCELERATION, 4, acceleration.round() as i64)?;
        bus.write(id, address::PROFILE_VELOCITY, 4, velocity)
    }

    /// Writes goals of all motors of each mode.
    fn write_goals(&mut self, commands: &[f64]) -> Result<(), Fault> {
        let Dynamixel { settings, bus, scratch, models, ids, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        let model = |id: u8| models[ids.iter().position(|other| *other == id).unwrap_or(0)];
        let modes: [(&[Mode], u16, u16); 3] = [
            (&[Mode::Position, Mode::ExtendedPosition], address::GOAL_POSITION, 4),
            (&[Mode::Velocity], address::GOAL_VELOCITY, 4),
            (&[Mode::Current], address::GOAL_CURRENT, 2),
        ];
        for (modes, register, size) in modes {
            let motors =
                settings.motors.iter().zip(commands).filter(|(motor, _)| modes.contains(&motor.mode));
            if motors.clone().next().is_none() {
                continue;
            }
            let goals =
                motors.map(|(motor, command)| (motor.id, goal(model(motor.id), motor.mode, *command)));
            bus.sync_write(register, size, goals, scratch)?;
        }
        Ok(())
    }
}

/// A command as the register that takes it.
fn goal(model: &Model, mode: Mode, command: f64) -> i64 {
    let unit = match mode {
        Mode::Velocity => Model::VELOCITY_UNIT,
        Mode::Current => model.current_unit.unwrap_or(f64::INFINITY),
        _ => Model::POSITION_UNIT,
    };
    let value = (command / unit).round() as i64;
    if mode == Mode::Position { value.clamp(0, 4095) } else { value }
}

impl Driver for Dynamixel {
    fn connect(&mut self) -> Result<(), Fault> {
        let Settings { port, baud, .. } = &self.settings;
        let opened = (self.opener)(port, *baud).map_err(|error| Fault::Unreachable(error.to_string()))?;
        self.bus = Some(Bus::new(opened, *baud));
        self.find()
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        let Dynamixel { bus, ids, states, settings, models, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        let mut alert = None;
        let all = bus.sync_read(PRESENT, PRESENT_SIZE, ids, |place, answer, data| {
            if answer.alert {
                alert.get_or_insert(ids[place]);
            }
            let [c0, c1, v0, v1, v2, v3, p0, p1, p2, p3] = *data else { return };
            states[place] = State {
                current: i16::from_le_bytes([c0, c1]),
                velocity: i32::from_le_bytes([v0, v1, v2, v3]),
                position: i32::from_le_bytes([p0, p1, p2, p3]),
            };
        })?;
        if let Some(id) = alert {
            let trouble = bus.trouble(id)?;
            return Err(Fault::Refused(format!("servo {id} reports {trouble}")));
        }
        if !all {
            return Err(Fault::Stale(0));
        }
        for (value, (id, quantity)) in values.iter_mut().zip(&settings.sensors) {
            let place = ids.iter().position(|other| other == id).unwrap_or(0);
            let state = &states[place];
            *value = match quantity {
                Quantity::Position => f64::from(state.position) * Model::POSITION_UNIT,
                Quantity::Velocity => f64::from(state.velocity) * Model::VELOCITY_UNIT,
                Quantity::Current => f64::from(state.current) * models[place].current_unit.unwrap_or(0.0),
            };
        }
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        let (motors, ids) = (self.settings.motors.clone(), self.ids.clone());
        let bus = self.bus()?;
        for (command, motor) in commands.iter_mut().zip(&motors) {
            *command = match motor.mode {
                Mode::Position | Mode::ExtendedPosition => {
                    debug_assert!(ids.contains(&motor.id));
                    bus.read(motor.id, address::PRESENT_POSITION, 4)? as f64 * Model::POSITION_UNIT
                }
                _ => 0.0,
            };
        }
        Ok(())
    }

    fn arm(&mut self, present: &[f64]) -> Result<(), Fault> {
        for motor in self.settings.motors.clone() {
            self.prepare(motor)?;
        }
        self.write_goals(present)?;
        for (motor, command) in self.settings.motors.clone().iter().zip(present) {
            // A goal that was lost on the way would let the servo leap to an old one.
            let (register, size) = match motor.mode {
                Mode::Velocity => (address::GOAL_VELOCITY, 4),
                Mode::Current => (address::GOAL_CURRENT, 2),
                _ => (address::GOAL_POSITION, 4),
            };
            let wanted = goal(self.models[self.place(motor.id)], motor.mode, *command);
            let bus = self.bus()?;
            if bus.read(motor.id, register, size)? != wanted {
                bus.write(motor.id, register, size, wanted)?;
            }
            bus.write(motor.id, address::TORQUE_ENABLE, 1, 1)?;
            bus.write(motor.id, address::BUS_WATCHDOG, 1, BUS_WATCHDOG)?;
        }
        Ok(())
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        self.write_goals(commands)
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        let safe = self.settings.safe;
        let mut first = Ok(true);
        for motor in self.settings.motors.clone() {
            let bus = self.bus()?;
            // Each servo is tried, whatever became of the one before.
            let outcome = match safe {
                Safe::Off => bus.write(motor.id, address::TORQUE_ENABLE, 1, 0),
                Safe::Hold => hold(bus, motor),
            };
            first = first.and(outcome.map(|()| true));
        }
        first
    }

    fn disconnect(&mut self) {
        self.bus = None;
    }

    fn limits(&self) -> Vec<Limits> {
        let motors = self.settings.motors.iter();
        motors
            .map(|motor| match motor.mode {
                Mode::Position => {
                    let [low, high] = motor.range;
                    Limits::of_value([low.max(0.0), high.min(TURN)])
                }
                Mode::ExtendedPosition => Limits::of_value(motor.range),
                _ => Limits::NONE,
            })
            .collect()
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: self.settings.watchdog, reading: READING, heartbeat: HEARTBEAT }
    }

    fn resource(&self) -> String {
        self.settings.port.clone()
    }

    fn reset_duration(&self) -> f64 {
        self.settings.reset_time
    }

    fn resets(&self) -> bool {
        let positions = |motor: &Motor| matches!(motor.mode, Mode::Position | Mode::ExtendedPosition);
        self.settings.motors.iter().all(positions)
    }
}

/// Stops a servo where it is, with torque; clears a bus watchdog that tripped, so that the goal can be written.
fn hold(bus: &mut Bus, motor: Motor) -> Result<(), Fault> {
    bus.write(motor.id, address::BUS_WATCHDOG, 1, 0)?;
    match motor.mode {
        Mode::Velocity => bus.write(motor.id, address::GOAL_VELOCITY, 4, 0),
        Mode::Current => bus.write(motor.id, address::GOAL_CURRENT, 2, 0),
        _ => {
            let here = bus.read(motor.id, address::PRESENT_POSITION, 4)?;
            bus.write(motor.id, address::GOAL_POSITION, 4, here)
        }
    }
}
