//! One servo: its control table, and what its motor does.

use super::instructions::{asked, together};
use super::memory::Memory;
use crate::chain::{Answer, Bus, Instruction, Member};
use crate::plant::{Drive, Plant};
use crate::profile::Profile;
use crate::shaft::Shaft;
use protocol::dynamixel::{Decoder, Mode, Model, address, encode, hardware_error, instruction, status_error};

/// How long a servo is silent after a reboot \[s\].
const REBOOT: f64 = 0.25;
/// Largest value of PWM.
const FULL_PWM: f64 = 885.0;

/// A servo, on the shaft of a motor of the plant or on none.
pub struct Servo {
    model: &'static Model,
    memory: Memory,
    shaft: Option<Shaft>,
    profile: Profile,
    registered: Option<(u16, Vec<u8>)>,
    /// When an instruction last came \[s\].
    heard: f64,
    silent_until: f64,
    powered: bool,
}

impl Servo {
    /// A servo as it leaves the factory, with this id.
    pub fn new(model: &'static Model, id: u8) -> Servo {
        let mut memory = Memory::new(model);
        memory.set(address::ID, i64::from(id));
        Servo {
            model,
            memory,
            shaft: None,
            profile: Profile::default(),
            registered: None,
            heard: 0.0,
            silent_until: 0.0,
            powered: true,
        }
    }

    /// Puts it on the shaft of a motor of the plant: angle \[rad\] = joint × scale + offset, where 0 is position 0.
    pub fn mount(&mut self, motor: usize, scale: f64, offset: f64) {
        self.shaft = Some(Shaft { motor, scale, offset });
    }

    /// Sets a register by hand, whatever its access: as an earlier user left it, or as a fault makes it.
    pub fn set_register(&mut self, address: u16, value: i64) {
        self.memory.set(address, value);
    }

    /// A register's value.
    pub fn register(&self, address: u16) -> i64 {
        self.memory.get(address)
    }

    /// Its hardware reports these errors from now on; those that the register "Shutdown" names take its torque.
    pub fn break_down(&mut self, errors: u8) {
        let errors = self.memory.get(address::HARDWARE_ERROR) as u8 | errors;
        self.memory.set(address::HARDWARE_ERROR, i64::from(errors));
        if errors & self.memory.get(address::SHUTDOWN) as u8 != 0 {
            self.memory.set(address::TORQUE_ENABLE, 0);
        }
    }

    /// The bus watchdog has found the bus silent.
    fn tripped(&self) -> bool {
        self.memory.get(address::BUS_WATCHDOG) == 255
    }

    /// Stops where it is: the goal is where it stands, and stays so until the watchdog is cleared.
    fn trip(&mut self, plant: &Plant) {
        self.measure(plant);
        let here = self.memory.get(address::PRESENT_POSITION);
        self.memory.set(address::BUS_WATCHDOG, 255);
        self.memory.set(address::GOAL_POSITION, here);
        self.memory.set(address::GOAL_VELOCITY, 0);
        self.memory.set(address::GOAL_CURRENT, 0);
        self.memory.set(address::GOAL_PWM, 0);
        self.profile = Profile::at(here as f64);
    }

    fn mode(&self) -> Mode {
        Mode::of(self.memory.get(address::OPERATING_MODE) as u8).unwrap_or(Mode::Position)
    }

    /// Whether its mode has a goal position.
    fn positions(&self) -> bool {
        matches!(self.mode(), Mode::Position | Mode::ExtendedPosition | Mode::CurrentPosition)
    }

    /// The drive of the motor for its mode and goals.
    fn drive(&mut self, dt: f64) -> Drive {
        let Some(shaft) = self.shaft else { return Drive::Off };
        let scale = shaft.scale;
        let get = |address| self.memory.get(address) as f64;
        match self.mode() {
            Mode::Velocity => Drive::Velocity(get(address::GOAL_VELOCITY) * Model::VELOCITY_UNIT / scale),
            Mode::Current => {
                let current = get(address::GOAL_CURRENT) * self.model.kind.current.unwrap_or(0.0);
                Drive::Effort(current * self.model.torque_constant() * scale)
            }
            Mode::Pwm => Drive::Effort(get(address::GOAL_PWM) / FULL_PWM * self.model.stall[0] * scale),
            Mode::Position | Mode::ExtendedPosition | Mode::CurrentPosition => {
                let per_second = Model::VELOCITY_UNIT / Model::POSITION_UNIT;
                let fastest = get(address::PROFILE_VELOCITY) * per_second;
                let acceleration =
                    get(address::PROFILE_ACCELERATION) * Model::ACCELERATION_UNIT / Model::POSITION_UNIT;
                let goal = get(address::GOAL_POSITION);
                let homing = get(address::HOMING_OFFSET);
                self.profile.advance(goal, fastest, acceleration, dt);
                let angle = (self.profile.position - homing) * Model::POSITION_UNIT;
                Drive::Control(shaft.joint(angle))
            }
        }
    }

    /// Writes the measured quantities to their registers.
    fn measure(&mut self, plant: &Plant) {
        let Some(shaft) = self.shaft else { return };
        let (angle, velocity, effort) = (shaft.angle(plant), shaft.velocity(plant), shaft.effort(plant));
        let position =
            (angle / Model::POSITION_UNIT).round() as i64 + self.memory.get(address::HOMING_OFFSET);
        // A servo that does not count turns shows the angle within one.
        let position = if self.mode() == Mode::Position { position.rem_euclid(4096) } else { position };
        let current = match self.model.kind.current {
            Some(unit) => effort / self.model.torque_constant() / unit,
            None => effort / self.model.stall[0] * 1000.0,
        };
        self.memory.set(address::PRESENT_POSITION, position);
        self.memory.set(address::PRESENT_VELOCITY, (velocity / Model::VELOCITY_UNIT).round() as i64);
        self.memory.set(address::PRESENT_CURRENT, current.round() as i64);
    }

    /// Warms it up to a temperature \[°C\]; above its limit it shuts down.
    pub fn heat(&mut self, celsius: u8) {
        self.memory.set(address::PRESENT_TEMPERATURE, i64::from(celsius));
        if i64::from(celsius) > self.memory.get(address::TEMPERATURE_LIMIT) {
            self.break_down(hardware_error::HEAT);
        }
    }
}

impl Member for Servo {
    type Decoder = Decoder;
    const LARGEST_ID: u8 = 252;
    const UNKNOWN: Option<u8> = Some(status_error::INSTRUCTION);

    fn instructions(decoder: &mut Decoder, bytes: &[u8]) -> Vec<Instruction> {
        decoder.push(bytes);
        let mut all = Vec::new();
        while let Some(packet) = decoder.next_packet() {
            // Of a packet with a wrong checksum nobody can say to whom it was; servos stay silent.
            let Ok(packet) = packet else { continue };
            // What other servos say is not for these.
            if packet.instruction != instruction::STATUS {
                let asked = asked(packet.instruction, packet.parameters);
                all.push(Instruction { id: packet.id, asked });
            }
        }
        all
    }

    fn encode(id: u8, error: u8, data: &[u8]) -> Option<Vec<u8>> {
        let mut bytes = Vec::new();
        encode(&mut bytes, id, instruction::STATUS, &[&[error], data]);
        Some(bytes)
    }

    fn together(bus: &mut Bus<Servo>, plant: &Plant, from: u16, length: u16, ids: &[u8]) -> Vec<Answer> {
        together(bus, plant, from, length, ids)
    }

    fn id(&self) -> u8 {
        self.memory.get(address::ID) as u8
    }

    fn set_powered(&mut self, powered: bool) {
        if powered && !self.powered {
            self.memory.reboot();
        }
        self.powered = powered;
    }

    fn listens(&self, now: f64) -> bool {
        self.powered && now >= self.silent_until
    }

    fn hear(&mut self, now: f64) {
        self.heard = now;
    }

    fn return_delay(&self) -> f64 {
        self.memory.get(address::RETURN_DELAY) as f64 * Model::DELAY_UNIT
    }

    fn answers(&self, level: i64) -> bool {
        self.memory.get(address::STATUS_RETURN) >= level
    }

    fn alarm(&self) -> u8 {
        if self.memory.get(address::HARDWARE_ERROR) != 0 { status_error::ALERT } else { 0 }
    }

    fn identity(&self) -> Vec<u8> {
        let [low, high] = self.model.kind.number.to_le_bytes();
        vec![low, high, self.memory.get(address::FIRMWARE) as u8]
    }

    fn read(&mut self, plant: &Plant, from: u16, length: u16, out: &mut Vec<u8>) -> Result<(), u8> {
        self.measure(plant);
        self.memory.read(from, length, out)
    }

    fn write(&mut self, plant: &Plant, from: u16, data: &[u8]) -> Result<(), u8> {
        let writes = |register: u16, size: u16| {
            from < register + size && register < from.saturating_add(data.len() as u16)
        };
        let torque = self.memory.get(address::TORQUE_ENABLE) != 0;
        if self.tripped() && writes(address::GOAL_PWM, address::GOAL_POSITION + 4 - address::GOAL_PWM) {
            return Err(status_error::ACCESS);
        }
        self.memory.write(from, data, torque)?;
        if self.model.modes.iter().all(|mode| *mode as i64 != self.memory.get(address::OPERATING_MODE)) {
            self.memory.set(address::OPERATING_MODE, Mode::Position as i64);
            return Err(status_error::DATA_RANGE);
        }
        let errors = self.memory.get(address::HARDWARE_ERROR) & self.memory.get(address::SHUTDOWN);
        if errors != 0 && self.memory.get(address::TORQUE_ENABLE) != 0 {
            self.memory.set(address::TORQUE_ENABLE, 0);
            return Err(status_error::ACCESS);
        }
        if !torque && self.memory.get(address::TORQUE_ENABLE) != 0 {
            self.measure(plant);
            self.profile = Profile::at(self.memory.get(address::PRESENT_POSITION) as f64);
        }
        Ok(())
    }

    fn keep(&mut self, write: Option<(u16, Vec<u8>)>) -> Option<(u16, Vec<u8>)> {
        self.memory.set(address::REGISTERED, i64::from(write.is_some()));
        std::mem::replace(&mut self.registered, write)
    }

    fn reboot(&mut self, now: f64) -> Result<(), u8> {
        self.memory.reboot();
        self.silent_until = now + REBOOT;
        Ok(())
    }

    /// A factory reset: of everything, of all but the id, or of all but id and baud rate.
    fn factory_reset(&mut self, how: u8, now: f64) -> Result<(), u8> {
        match how {
            0xFF => self.memory.reset(false, false),
            0x01 => self.memory.reset(true, false),
            0x02 => self.memory.reset(true, true),
            _ => return Err(status_error::DATA_RANGE),
        }
        self.silent_until = now + REBOOT;
        Ok(())
    }

    fn tick(&mut self, plant: &mut Plant, now: f64, dt: f64) {
        let watchdog = self.memory.get(address::BUS_WATCHDOG);
        let on = self.powered && self.memory.get(address::TORQUE_ENABLE) != 0;
        if on && (1..128).contains(&watchdog) && now - self.heard > watchdog as f64 * Model::WATCHDOG_UNIT {
            self.trip(plant);
        }
        let ticks = (self.memory.get(address::REALTIME_TICK) as f64 + dt * 1e3) as i64;
        self.memory.set(address::REALTIME_TICK, ticks % 32_768);
        let drive = if on { self.drive(dt) } else { Drive::Off };
        let goal = self.memory.get(address::GOAL_POSITION) as f64;
        let moving = on && self.positions() && !self.profile.done(goal);
        self.memory.set(address::MOVING, i64::from(moving));
        if let Some(shaft) = self.shaft {
            plant.drive(shaft.motor, drive);
        }
    }
}
