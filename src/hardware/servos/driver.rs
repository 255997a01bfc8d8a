//! The driver of a bus of servos.

use super::bus::{Bus, Reading};
use super::settings::{Make, Motor, Quantity, Safe, Settings};
use crate::driver::Driver;
use crate::parameters::Parameters;
use crate::port::Opener;
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use protocol::servo::{Kind, Layout, Mode, Setting};
use robot::{DeviceConfig, Fault};

/// Watchdog of the bus in the servos, in units of 20 ms.
const BUS_WATCHDOG: i64 = 5;
/// Time without a reading after which the servos are made safe \[s\]: three lost answers, with their timeouts.
const READING: f64 = 0.09;
/// Time between two readings by the watchdog, where the program reads nothing \[s\].
const HEARTBEAT: f64 = 0.02;
/// Time in which a servo does not answer after a restart, with a margin \[s\].
const REBOOT: f64 = 0.4;

/// A servo that answered.
#[derive(Clone, Copy, Debug)]
struct Found {
    kind: &'static Kind,
    /// Smallest and largest goal position, in its units.
    limits: [i64; 2],
    /// Its last position, velocity and current, in its units.
    present: [i64; 3],
}

/// Servos on a serial bus, see [`dynamixel`](crate::dynamixel) and [`feetech`](crate::feetech).
pub struct Servos {
    settings: Settings,
    layout: &'static Layout,
    opener: Opener,
    bus: Option<Bus>,
    reading: Reading,
    ids: Vec<u8>,
    /// What answered, by id.
    found: Vec<Found>,
}

impl Servos {
    /// The driver of a device; `make` reads the parameters of its make. Nothing is opened yet.
    ///
    /// # Errors
    /// A parameter that is missing or wrong.
    pub(crate) fn new(
        config: &DeviceConfig,
        opener: Opener,
        make: impl FnOnce(&mut Parameters) -> Result<Make, Fault>,
    ) -> Result<Servos, Fault> {
        let settings = Settings::new(config, make)?;
        let family = settings.make.family;
        let kind = &family.kinds[0];
        let (ids, nothing) = (settings.ids(), Found { kind, limits: [0, kind.last], present: [0; 3] });
        Ok(Servos {
            layout: family.layout,
            opener,
            bus: None,
            reading: Reading::Each,
            found: vec![nothing; 1 + usize::from(u8::MAX)],
            ids,
            settings,
        })
    }

    fn bus(&mut self) -> Result<&mut Bus, Fault> {
        self.bus.as_mut().ok_or(Fault::NotConnected)
    }

    fn kind(&self, id: u8) -> &'static Kind {
        self.found[usize::from(id)].kind
    }

    /// A fault of a servo while it is connected: one that is silent is not there.
    fn missing(&self, id: u8, fault: Fault) -> Fault {
        let Settings { port, baud, .. } = &self.settings;
        match fault {
            Fault::Stale(_) => Fault::Unreachable(format!(
                "servo {id} does not answer at {baud} baud on {port}; check its power, its id, its baud rate and its protocol"
            )),
            fault => fault,
        }
    }

    /// Finds a servo, and restarts it where that clears an error of its hardware.
    fn find(&mut self, id: u8) -> Result<Found, Fault> {
        let Make { family, model: wanted, .. } = self.settings.make;
        let layout = self.layout;
        let bus = self.bus()?;
        let (number, mut error) = bus.look(id, layout.model)?;
        if family.reboots && bus.trouble(id, error)?.is_some() {
            bus.reboot(id)?;
            bus.wait(REBOOT);
            error = bus.look(id, layout.model)?.1;
        }
        if let Some(trouble) = bus.trouble(id, error)? {
            let again = if family.reboots { ", even after a reboot" } else { "" };
            return Err(Fault::Hardware(format!("servo {id}: {trouble}{again}")));
        }
        let kind = family.kinds.iter().find(|kind| i64::from(kind.number) == number).ok_or_else(|| {
            let known: Vec<_> = family.kinds.iter().map(|kind| kind.name).collect();
            Fault::Refused(format!(
                "servo {id} has the unknown model number {number}; supported models are {}",
                known.join(", ")
            ))
        })?;
        if let Some(model) = wanted.filter(|model| *model != kind.name) {
            let name = kind.name;
            return Err(Fault::Refused(format!(
                "servo {id} is an {name}, and the config says {model}; change the config's 'model'"
            )));
        }
        let [low, high] = layout.limits;
        let limits = [bus.read_twice(id, low)?, bus.read_twice(id, high)?];
        Ok(Found { kind, limits, present: [0; 3] })
    }

    /// Checks that every servo supports its mode and its sensors in the config.
    fn check_abilities(&self) -> Result<(), Fault> {
        for motor in &self.settings.motors {
            let kind = self.kind(motor.id);
            if kind.modes.iter().all(|(mode, _)| *mode != motor.mode) {
                let (id, name, mode) = (motor.id, kind.name, motor.mode.name());
                return Err(Fault::Refused(format!("servo {id}, an {name}, has no mode '{mode}'")));
            }
        }
        for (id, _) in self.settings.sensors.iter().filter(|(_, quantity)| *quantity == Quantity::Current) {
            let kind = self.kind(*id);
            if kind.current.is_none() {
                return Err(Fault::Refused(format!("servo {id}, an {}, measures no current", kind.name)));
            }
        }
        Ok(())
    }

    /// How the servos are read: by one packet if every firmware supports it.
    fn choose_reading(&mut self) -> Result<Reading, Fault> {
        let make = &self.settings.make;
        let Some(firmware) = self.layout.firmware.filter(|_| make.fast_sync_read) else {
            return Ok(if make.family.sync_read { Reading::Sync } else { Reading::Each });
        };
        for place in 0..self.ids.len() {
            let id = self.ids[place];
            let first = self.kind(id).fast_sync_read;
            let version = self.bus()?.read_twice(id, firmware);
            let version = version.map_err(|fault| self.missing(id, fault))?;
            if first.is_none_or(|first| version < first) {
                return Ok(Reading::Sync);
            }
        }
        Ok(Reading::Fast)
    }

    /// Sets up a servo before its torque is switched on: mode, return delay, speed and acceleration.
    fn prepare(&mut self, motor: Motor) -> Result<(), Fault> {
        let (id, kind, layout) = (motor.id, self.kind(motor.id), self.layout);
        let Make { speed, acceleration, return_delay, .. } = self.settings.make;
        let bus = self.bus()?;
        if let Some(watchdog) = layout.watchdog {
            bus.write(id, watchdog, 0)?;
        }
        let delay = layout
            .return_delay
            .map(|(cell, unit)| Setting::exactly(cell, (return_delay / unit).round() as i64));
        let mode =
            kind.modes.iter().find(|(mode, _)| *mode == motor.mode).map_or(&[][..], |(_, needs)| needs);
        // These registers are in non-volatile memory with a limited number of writes, and can only be written with torque off: they
        // are written only where they differ.
        for Setting { cell, allowed: [low, high], otherwise } in delay.iter().chain(mode) {
            if (*low..=*high).contains(&bus.read_twice(id, *cell)?) {
                continue;
            }
            bus.write(id, layout.torque, 0)?;
            if let Some(lock) = layout.lock {
                bus.write(id, lock, 0)?;
            }
            bus.write_surely(id, *cell, *otherwise)?;
            if let Some(lock) = layout.lock {
                bus.write(id, lock, 1)?;
            }
        }
        if let Some([limit, whole]) = layout.torque_limit
            && bus.read(id, limit)? == 0
        {
            let whole = bus.read_twice(id, whole)?;
            bus.write(id, limit, whole)?;
        }
        if let Some(cell) = layout.acceleration {
            bus.write(id, cell, (acceleration / kind.acceleration).round() as i64)?;
        }
        // Where one register is both speed limit and goal velocity, in velocity mode it is the goal.
        if layout.goal(motor.mode) == Some(layout.speed) {
            return Ok(());
        }
        let speed = match (speed, layout.velocity_limit) {
            // At least one unit: 0 would be no limit.
            (Some(speed), _) if speed > 0.0 => ((speed / kind.velocity).round() as i64).max(1),
            (None, Some(limit)) => bus.read(id, limit)?,
            _ => 0,
        };
        bus.write(id, layout.speed, speed)
    }

    /// Writes the goals of all motors, in one packet for each goal register.
    fn write_goals(&mut self, commands: &[f64]) -> Result<(), Fault> {
        let Servos { settings, bus, found, layout, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        for cell in
            [Mode::Position, Mode::Velocity, Mode::Current].into_iter().filter_map(|mode| layout.goal(mode))
        {
            let motors = settings.motors.iter().zip(commands);
            let motors = motors.filter(|(motor, _)| layout.goal(motor.mode) == Some(cell));
            let goal = |m: &Motor, command| goal(found[usize::from(m.id)].kind, m.mode, command);
            bus.write_all(cell, motors.map(|(m, command)| (m.id, goal(m, *command))))?;
        }
        Ok(())
    }

    /// Stops a servo where it is, with torque; first clears a tripped bus watchdog, so that the goal can be written.
    fn hold(&mut self, motor: Motor) -> Result<(), Fault> {
        let layout = self.layout;
        let bus = self.bus()?;
        if let Some(watchdog) = layout.watchdog {
            bus.write(motor.id, watchdog, 0)?;
        }
        let here = match motor.mode {
            Mode::Position | Mode::Turns => bus.read(motor.id, layout.position)?,
            Mode::Velocity | Mode::Current => 0,
        };
        layout.goal(motor.mode).map_or(Ok(()), |goal| bus.write(motor.id, goal, here))
    }
}

/// The register value of a command.
fn goal(kind: &Kind, mode: Mode, command: f64) -> i64 {
    match mode {
        Mode::Position => ((command / kind.position).round() as i64).clamp(0, kind.last),
        Mode::Turns => (command / kind.position).round() as i64,
        Mode::Velocity => (command / kind.velocity).round() as i64,
        Mode::Current => kind.current.map_or(0, |unit| (command / unit).round() as i64),
    }
}

impl Driver for Servos {
    fn connect(&mut self) -> Result<(), Fault> {
        let Settings { port, baud, make, .. } = &self.settings;
        let opened = (self.opener)(port, *baud).map_err(|error| Fault::Unreachable(error.to_string()))?;
        self.bus = Some(Bus::new(opened, *baud, make.family));
        for place in 0..self.ids.len() {
            let id = self.ids[place];
            self.found[usize::from(id)] = self.find(id).map_err(|fault| self.missing(id, fault))?;
        }
        self.check_abilities()?;
        self.reading = self.choose_reading()?;
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        let Servos { bus, ids, found, settings, layout, reading, .. } = self;
        let bus = bus.as_mut().ok_or(Fault::NotConnected)?;
        let mut broken = None;
        let (from, size) = layout.present();
        let all = bus.read_all(*reading, (from, size), ids, |place, error, data| {
            if error != 0 {
                broken.get_or_insert((ids[place], error));
            }
            let cells = [Some(layout.position), Some(layout.velocity), layout.current];
            found[usize::from(ids[place])].present = cells.map(|cell| {
                cell.map_or(0, |cell| {
                    let at = usize::from(cell.address - from);
                    cell.decode(&data[at..at + usize::from(cell.size)])
                })
            });
        })?;
        if let Some((id, error)) = broken
            && let Some(trouble) = bus.trouble(id, error)?
        {
            return Err(Fault::Hardware(format!("servo {id}: {trouble}")));
        }
        if !all {
            return Err(Fault::Stale(0));
        }
        for (value, (id, quantity)) in values.iter_mut().zip(&settings.sensors) {
            let Found { kind, present: [position, velocity, current], .. } = found[usize::from(*id)];
            *value = match quantity {
                Quantity::Position => position as f64 * kind.position,
                Quantity::Velocity => velocity as f64 * kind.velocity,
                Quantity::Current => current as f64 * kind.current.unwrap_or(f64::NAN),
            };
        }
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        for (command, motor) in commands.iter_mut().zip(self.settings.motors.clone()) {
            let (unit, cell) = (self.kind(motor.id).position, self.layout.position);
            *command = match motor.mode {
                Mode::Position | Mode::Turns => self.bus()?.read(motor.id, cell)? as f64 * unit,
                Mode::Velocity | Mode::Current => 0.0,
            };
        }
        Ok(())
    }

    fn arm(&mut self, present: &[f64]) -> Result<(), Fault> {
        let layout = self.layout;
        for motor in self.settings.motors.clone() {
            self.prepare(motor)?;
        }
        for (motor, command) in self.settings.motors.clone().iter().zip(present) {
            let wanted = goal(self.kind(motor.id), motor.mode, *command);
            let bus = self.bus()?;
            if let Some(cell) = layout.goal(motor.mode) {
                // If this goal were lost, the servo would jump to an old one.
                bus.write_surely(motor.id, cell, wanted)?;
            }
            bus.write(motor.id, layout.torque, 1)?;
            if let Some(watchdog) = layout.watchdog {
                bus.write(motor.id, watchdog, BUS_WATCHDOG)?;
            }
        }
        Ok(())
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        self.write_goals(commands)
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        let (safe, torque) = (self.settings.safe, self.layout.torque);
        let mut first = Ok(true);
        for motor in self.settings.motors.clone() {
            // Each servo is tried, even if another one failed.
            let outcome = match safe {
                Safe::Off => self.bus()?.write(motor.id, torque, 0),
                Safe::Hold => self.hold(motor),
            };
            first = first.and(outcome.map(|()| true));
        }
        first
    }

    fn disconnect(&mut self) {
        self.bus = None;
    }

    fn limits(&self) -> Vec<Limits> {
        let limits = |motor: &Motor| {
            let Found { kind, limits: [low, high], .. } = self.found[usize::from(motor.id)];
            let [least, most] = [low.max(0), high.min(kind.last)].map(|end| end as f64 * kind.position);
            match motor.mode {
                // In wheel mode both limits are 0; they are set when the servo is armed.
                Mode::Position if least < most => {
                    Limits::of_value([motor.range[0].max(least), motor.range[1].min(most)])
                }
                Mode::Position | Mode::Turns => Limits::of_value(motor.range),
                Mode::Velocity | Mode::Current => Limits::NONE,
            }
        };
        self.settings.motors.iter().map(limits).collect()
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
        let positions = |motor: &Motor| matches!(motor.mode, Mode::Position | Mode::Turns);
        self.settings.motors.iter().all(positions)
    }
}
