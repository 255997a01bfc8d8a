//! The driver of a bus of servos.

use super::bus::Bus;
use crate::driver::Driver;
use crate::parameters::Parameters;
use crate::port::Opener;
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use crate::servos::{self, Quantity, Safe};
use protocol::feetech::{ACCELERATION_UNIT, CURRENT_UNIT, STEP, STS3215, address, signed, trouble, unsigned};
use robot::{ActuatorConfig, DeviceConfig, Fault};

/// Without a reading for this long the servos are made safe \[s\]: three lost answers, each with the wait for it.
const READING: f64 = 0.09;
/// Time between two readings of servos that nobody else reads \[s\].
const HEARTBEAT: f64 = 0.02;
/// Bytes from the present position to the present current.
const PRESENT: usize = 15;

/// A servo that is commanded.
#[derive(Clone, Copy, Debug)]
struct Motor {
    id: u8,
    velocity: bool,
    /// \[rad\].
    range: [f64; 2],
}

/// What a servo last said.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    position: f64,
    velocity: f64,
    current: f64,
}

/// Servos on a serial bus, see [the module](super).
pub struct Feetech {
    port: String,
    baud: u32,
    safe: Safe,
    speed: u16,
    acceleration: u8,
    watchdog: f64,
    reset_time: f64,
    motors: Vec<Motor>,
    sensors: Vec<(u8, Quantity)>,
    ids: Vec<u8>,
    states: Vec<State>,
    opener: Opener,
    bus: Option<Bus>,
    scratch: Vec<u8>,
}

fn motor(config: &ActuatorConfig) -> Result<Motor, Fault> {
    let velocity = match config.mode.as_deref().map(str::to_ascii_lowercase).as_deref() {
        None | Some("position") => false,
        Some("velocity") => true,
        Some(other) => {
            let name = &config.name;
            return Err(Fault::Refused(format!("'{name}' has mode '{other}'; there are position, velocity")));
        }
    };
    Ok(Motor { id: servos::id(config)?, velocity, range: servos::range(config) })
}

impl Feetech {
    /// The driver of a device; nothing is opened yet.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub fn new(config: &DeviceConfig, opener: Opener) -> Result<Feetech, Fault> {
        let mut parameters = Parameters::new(config);
        let port = parameters.text("name")?.ok_or_else(|| {
            Fault::Refused(
                "its interface has no 'name', the path of the serial port, as '/dev/ttyACM0'".to_owned(),
            )
        })?;
        let baud = parameters.number("baud", 1e6, [19_200.0, 1e6])? as u32;
        let safe = [Safe::Hold, Safe::Off][parameters.choice("safe", &["hold", "off"])?];
        let speed = parameters.number("speed", 3.0, [0.0, 20.0])? / STEP;
        let acceleration = parameters.number("acceleration", 20.0, [0.0, 39.0])? / ACCELERATION_UNIT;
        let watchdog = parameters.number("watchdog", 0.25, [0.02, 10.0])?;
        let reset_time = parameters.number("reset_time", 5.0, [0.1, 60.0])?;
        parameters.finish()?;
        let motors = config.actuators.iter().map(motor).collect::<Result<Vec<_>, _>>()?;
        servos::unique(motors.iter().map(|motor| motor.id))?;
        let sensors = servos::sensors(&config.sensors)?;
        let ids = servos::all(motors.iter().map(|motor| motor.id), &sensors);
        Ok(Feetech {
            states: vec![State::default(); ids.len()],
            scratch: Vec::with_capacity(8 * ids.len()),
            speed: speed.round() as u16,
            acceleration: acceleration.round() as u8,
            bus: None,
            port,
            baud,
            safe,
            watchdog,
            reset_time,
            motors,
            sensors,
            ids,
            opener,
        })
    }

    fn bus(&mut self) -> Result<&mut Bus, Fault> {
        self.bus.as_mut().ok_or(Fault::NotConnected)
    }

    /// Writes the goals of all motors.
    fn write_goals(&mut self, commands: &[f64]) -> Result<(), Fault> {
        let Feetech { bus, motors, scratch, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        let of =
            |velocity: bool| motors.iter().zip(commands).filter(move |(motor, _)| motor.velocity == velocity);
        let steps = |command: f64| signed((command / STEP).round() as i32).to_le_bytes();
        for (velocity, register) in [(false, address::GOAL_POSITION), (true, address::GOAL_VELOCITY)] {
            if of(velocity).next().is_some() {
                let goals = of(velocity).map(|(motor, command)| (motor.id, steps(*command)));
                bus.sync_write(register, goals, scratch)?;
            }
        }
        Ok(())
    }
}

impl Driver for Feetech {
    fn connect(&mut self) -> Result<(), Fault> {
        let opened =
            (self.opener)(&self.port, self.baud).map_err(|error| Fault::Unreachable(error.to_string()))?;
        let mut bus = Bus::new(opened, self.baud);
        for id in &self.ids {
            let missing = |fault| match fault {
                Fault::Stale(_) => Fault::Unreachable(format!(
                    "servo {id} does not answer at {} baud on {}; check its power, its id and its baud rate",
                    self.baud, self.port
                )),
                other => other,
            };
            bus.ping(*id).map_err(missing)?;
            let model = u16::from_le_bytes(bus.read(*id, address::MODEL)?);
            if model != STS3215 {
                return Err(Fault::Refused(format!(
                    "servo {id} is of model {model}; this driver knows the STS3215, {STS3215}"
                )));
            }
        }
        self.bus = Some(bus);
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        let Feetech { bus, ids, states, sensors, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        let mut broken = None;
        let all = bus.sync_read::<PRESENT>(address::PRESENT_POSITION, ids, |place, error, data| {
            if error != 0 {
                broken.get_or_insert((ids[place], error));
            }
            let register = |at: usize| u16::from_le_bytes([data[at], data[at + 1]]);
            states[place] = State {
                position: f64::from(unsigned(register(0))) * STEP,
                velocity: f64::from(unsigned(register(2))) * STEP,
                current: f64::from(register(13)) * CURRENT_UNIT,
            };
        })?;
        if let Some((id, error)) = broken {
            return Err(Fault::Refused(format!("servo {id} reports {}", trouble::describe(error))));
        }
        if !all {
            return Err(Fault::Stale(0));
        }
        for (value, (id, quantity)) in values.iter_mut().zip(&*sensors) {
            let state = &states[ids.iter().position(|other| other == id).unwrap_or(0)];
            *value = match quantity {
                Quantity::Position => state.position,
                Quantity::Velocity => state.velocity,
                Quantity::Current => state.current,
            };
        }
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        for (command, motor) in commands.iter_mut().zip(self.motors.clone()) {
            *command = 0.0;
            if !motor.velocity {
                let steps = u16::from_le_bytes(self.bus()?.read(motor.id, address::PRESENT_POSITION)?);
                *command = f64::from(unsigned(steps)) * STEP;
            }
        }
        Ok(())
    }

    fn arm(&mut self, present: &[f64]) -> Result<(), Fault> {
        let (speed, acceleration) = (self.speed.to_le_bytes(), self.acceleration);
        for motor in self.motors.clone() {
            let bus = self.bus()?;
            let mode = u8::from(motor.velocity);
            // It outlives a restart in memory that wears, and takes the torque away: written only where it differs. Answers
            // carry no number: one that is late can be taken for another, so that two must agree.
            if bus.read(motor.id, address::MODE)? != [mode] && bus.read(motor.id, address::MODE)? != [mode] {
                bus.write(motor.id, address::TORQUE_ENABLE, &[0])?;
                bus.write(motor.id, address::LOCK, &[0])?;
                bus.write(motor.id, address::MODE, &[mode])?;
                bus.write(motor.id, address::LOCK, &[1])?;
            }
            bus.write(motor.id, address::ACCELERATION, &[acceleration])?;
            let velocity = if motor.velocity { [0; 2] } else { speed };
            bus.write(motor.id, address::GOAL_VELOCITY, &velocity)?;
        }
        for (motor, command) in self.motors.clone().into_iter().zip(present) {
            let goal = signed((command / STEP).round() as i32).to_le_bytes();
            let bus = self.bus()?;
            if !motor.velocity {
                bus.write(motor.id, address::GOAL_POSITION, &goal)?;
            }
            bus.write(motor.id, address::TORQUE_ENABLE, &[1])?;
        }
        Ok(())
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        self.write_goals(commands)
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        let safe = self.safe;
        let mut first = Ok(true);
        for motor in self.motors.clone() {
            let bus = self.bus()?;
            // Each servo is tried, whatever became of the one before.
            let outcome = match (safe, motor.velocity) {
                (Safe::Off, _) => bus.write(motor.id, address::TORQUE_ENABLE, &[0]),
                (Safe::Hold, true) => bus.write(motor.id, address::GOAL_VELOCITY, &[0; 2]),
                (Safe::Hold, false) => bus
                    .read::<2>(motor.id, address::PRESENT_POSITION)
                    .and_then(|here| bus.write(motor.id, address::GOAL_POSITION, &here)),
            };
            first = first.and(outcome.map(|()| true));
        }
        first
    }

    fn disconnect(&mut self) {
        self.bus = None;
    }

    fn limits(&self) -> Vec<Limits> {
        let limits = |motor: &Motor| match motor.velocity {
            true => Limits::NONE,
            false => Limits::of_value([motor.range[0].max(0.0), motor.range[1].min(4095.0 * STEP)]),
        };
        self.motors.iter().map(limits).collect()
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: self.watchdog, reading: READING, heartbeat: HEARTBEAT }
    }

    fn resource(&self) -> String {
        self.port.clone()
    }

    fn reset_duration(&self) -> f64 {
        self.reset_time
    }

    fn resets(&self) -> bool {
        self.motors.iter().all(|motor| !motor.velocity)
    }
}
