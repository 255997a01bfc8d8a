//! Feetech servos of the STS series on a bus.

use crate::device::{Device, Moment};
use crate::plant::{Drive, Plant, PlantError};
use crate::profile::Profile;
use crate::shaft::Shaft;
use protocol::feetech::{
    ACCELERATION_UNIT, BROADCAST, CURRENT_UNIT, Decoder, STEP, STS3215, TABLE, address, encode, instruction,
    signed, unsigned,
};
use robot::{DeviceConfig, HardwareId};

/// Torque of one ampere \[N m/A\]: an STS3215 holds 1.96 N m (20 kg cm) at 2.7 A.
const TORQUE_CONSTANT: f64 = 1.96 / 2.7;
/// Position control, the mode of a new servo.
const POSITION: u8 = 0;
/// Velocity control.
const VELOCITY: u8 = 1;

/// A servo, on the shaft of a motor of the plant or on none.
pub struct Servo {
    table: [u8; TABLE],
    shaft: Option<Shaft>,
    profile: Profile,
    registered: Option<(u8, Vec<u8>)>,
    powered: bool,
}

impl Servo {
    /// A servo as it leaves the factory, with this id.
    pub fn new(id: u8) -> Servo {
        let mut servo = Servo {
            table: [0; TABLE],
            shaft: None,
            profile: Profile::default(),
            registered: None,
            powered: true,
        };
        servo.restart();
        servo.set(address::MODEL, STS3215);
        servo.table[usize::from(address::ID)] = id;
        servo.set(address::MAX_ANGLE, 4095);
        servo.table[usize::from(address::MAX_TEMPERATURE)] = 70;
        servo.set(address::MAX_TORQUE, 1000);
        servo.set(address::TORQUE_LIMIT, 1000);
        servo
    }

    /// Puts it on the shaft of a motor of the plant: angle \[rad\] = joint × scale + offset, where 0 is position 0.
    pub fn mount(&mut self, motor: usize, scale: f64, offset: f64) {
        self.shaft = Some(Shaft { motor, scale, offset });
    }

    /// Its id.
    pub fn id(&self) -> u8 {
        self.table[usize::from(address::ID)]
    }

    /// Its status has these bits from now on, and it has no torque.
    pub fn break_down(&mut self, bits: u8) {
        self.table[usize::from(address::STATUS)] |= bits;
        self.table[usize::from(address::TORQUE_ENABLE)] = 0;
    }

    /// What a restart leaves of the registers that do not outlive it.
    fn restart(&mut self) {
        self.table[usize::from(address::TORQUE_ENABLE)..].fill(0);
        self.table[usize::from(address::LOCK)] = 1;
        self.table[usize::from(address::PRESENT_VOLTAGE)] = 74;
        self.table[usize::from(address::PRESENT_TEMPERATURE)] = 30;
        let torque = self.get(address::MAX_TORQUE);
        self.set(address::TORQUE_LIMIT, torque);
    }

    fn get(&self, at: u8) -> u16 {
        u16::from_le_bytes([self.table[usize::from(at)], self.table[usize::from(at) + 1]])
    }

    fn set(&mut self, at: u8, value: u16) {
        self.table[usize::from(at)..usize::from(at) + 2].copy_from_slice(&value.to_le_bytes());
    }

    fn torque(&self) -> bool {
        self.powered && self.table[usize::from(address::TORQUE_ENABLE)] == 1
    }

    fn read(&mut self, plant: &Plant, from: u8, count: u8, out: &mut Vec<u8>) {
        self.measure(plant);
        let bytes = (usize::from(from)..usize::from(from) + usize::from(count)).map(|at| self.table.get(at));
        out.extend(bytes.map(|byte| byte.copied().unwrap_or(0)));
    }

    /// Writes what may be written: registers below the torque switch while they are not locked, none that is measured.
    fn write(&mut self, plant: &Plant, from: u8, data: &[u8]) {
        let torque = self.torque();
        for (at, byte) in (usize::from(from)..).zip(data) {
            let lasting = at < usize::from(address::TORQUE_ENABLE);
            let measured = (usize::from(address::PRESENT_POSITION)..80).contains(&at);
            let unlocked = self.table[usize::from(address::LOCK)] == 0;
            if at < TABLE && at >= usize::from(address::ID) && !measured && (!lasting || unlocked) {
                self.table[at] = *byte;
            }
        }
        if self.table[usize::from(address::STATUS)] != 0 {
            self.table[usize::from(address::TORQUE_ENABLE)] = 0;
        }
        if !torque && self.torque() {
            self.measure(plant);
            self.profile = Profile::at(f64::from(self.get(address::PRESENT_POSITION)));
        }
    }

    /// Drives the motor for the time step to come, which takes `dt` seconds.
    fn tick(&mut self, plant: &mut Plant, dt: f64) {
        let goal = f64::from(unsigned(self.get(address::GOAL_POSITION)));
        let Some(shaft) = self.shaft else { return };
        let drive = match self.table[usize::from(address::MODE)] {
            _ if !self.torque() => Drive::Off,
            POSITION => {
                let low = f64::from(self.get(address::MIN_ANGLE));
                let goal = goal.clamp(low, f64::from(self.get(address::MAX_ANGLE)).max(low));
                let fastest = f64::from(unsigned(self.get(address::GOAL_VELOCITY)).abs());
                let steps = ACCELERATION_UNIT / STEP;
                let acceleration = f64::from(self.table[usize::from(address::ACCELERATION)]) * steps;
                self.profile.advance(goal, fastest, acceleration, dt);
                Drive::Control(shaft.joint(self.profile.position * STEP))
            }
            VELOCITY => {
                Drive::Velocity(f64::from(unsigned(self.get(address::GOAL_VELOCITY))) * STEP / shaft.scale)
            }
            _ => Drive::Off,
        };
        let moving = self.torque() && !self.profile.done(goal);
        self.table[usize::from(address::MOVING)] = u8::from(moving);
        plant.drive(shaft.motor, drive);
    }

    /// Fills the registers that say how it is.
    fn measure(&mut self, plant: &Plant) {
        let Some(shaft) = self.shaft else { return };
        let position = (shaft.angle(plant) / STEP).round().rem_euclid(4096.0);
        self.set(address::PRESENT_POSITION, position as u16);
        self.set(address::PRESENT_VELOCITY, signed((shaft.velocity(plant) / STEP).round() as i32));
        let current = shaft.effort(plant).abs() / TORQUE_CONSTANT / CURRENT_UNIT;
        self.set(address::PRESENT_CURRENT, current.round() as u16);
    }
}

/// Silence after which what was heard of an instruction is forgotten \[s\]: a damaged length would wait for bytes for ever.
const GAP: f64 = 0.01;

/// Servos on one line.
pub struct Bus {
    servos: Vec<Servo>,
    decoder: Decoder,
    /// Seconds a byte takes, for answers that follow each other.
    byte: f64,
    /// When bytes last came \[s\].
    heard: f64,
}

impl Bus {
    /// Servos whose answers follow each other at once.
    pub fn new(servos: Vec<Servo>) -> Bus {
        Bus { servos, decoder: Decoder::default(), byte: 0.0, heard: 0.0 }
    }

    /// Lets the answers to a sync read follow each other at this baud rate; the link itself is told separately.
    #[must_use]
    pub fn with_baud(mut self, baud: f64) -> Bus {
        self.byte = 10.0 / baud;
        self
    }

    /// Lets the servos of `id` do something and answer.
    fn each(&mut self, id: u8, mut act: impl FnMut(&mut Servo, &mut Vec<u8>)) -> Vec<Vec<u8>> {
        let chosen =
            self.servos.iter_mut().filter(|servo| servo.powered && (id == BROADCAST || servo.id() == id));
        let answer = |servo: &mut Servo| {
            let (mut parameters, mut bytes) = (Vec::new(), Vec::new());
            act(servo, &mut parameters);
            let status = servo.table[usize::from(address::STATUS)];
            encode(&mut bytes, servo.id(), status, &[&parameters]);
            bytes
        };
        chosen.map(answer).collect()
    }

    /// Does what a packet asks for; returns the answers.
    fn follow(&mut self, plant: &Plant, id: u8, code: u8, parameters: &[u8]) -> Vec<Vec<u8>> {
        let quiet = |answers| if id == BROADCAST { Vec::new() } else { answers };
        match (code, parameters) {
            (instruction::PING, _) => self.each(id, |_, _| {}),
            (instruction::READ, [from, count]) => {
                quiet(self.each(id, |servo, out| servo.read(plant, *from, *count, out)))
            }
            (instruction::WRITE, [from, data @ ..]) => {
                quiet(self.each(id, |servo, _| servo.write(plant, *from, data)))
            }
            (instruction::REG_WRITE, [from, data @ ..]) => {
                quiet(self.each(id, |servo, _| servo.registered = Some((*from, data.to_vec()))))
            }
            (instruction::ACTION, _) => quiet(self.each(id, |servo, _| {
                if let Some((from, data)) = servo.registered.take() {
                    servo.write(plant, from, &data);
                }
            })),
            (instruction::SYNC_READ, [from, count, ids @ ..]) => {
                ids.iter().flat_map(|id| self.each(*id, |s, out| s.read(plant, *from, *count, out))).collect()
            }
            (instruction::SYNC_WRITE, [from, count, data @ ..]) => {
                for entry in data.chunks_exact(usize::from(*count) + 1) {
                    self.each(entry[0], |servo, _| servo.write(plant, *from, &entry[1..]));
                }
                Vec::new()
            }
            _ => Vec::new(),
        }
    }
}

impl Device for Bus {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        if moment.time - self.heard > GAP {
            self.decoder.clear();
        }
        self.heard = moment.time;
        let mut decoder = std::mem::take(&mut self.decoder);
        decoder.push(bytes);
        while let Some(packet) = decoder.next_packet() {
            let mut due = moment.time;
            for answer in self.follow(moment.plant, packet.id, packet.code, packet.parameters) {
                let length = answer.len() as f64;
                moment.outbox.send(channel, due, answer);
                due += length * self.byte;
            }
        }
        self.decoder = decoder;
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        let dt = moment.plant.model().opt.timestep;
        self.servos.iter_mut().for_each(|servo| servo.tick(moment.plant, dt));
    }

    fn stop_button(&mut self, pressed: bool) {
        for servo in &mut self.servos {
            if !pressed && !servo.powered {
                servo.restart();
            }
            servo.powered = !pressed;
        }
    }
}

/// A servo for every actuator of a device, on the motor that it names, with the angle that its scale and offset make.
///
/// # Errors
/// Actuators that the plant does not have, and ids that no servo can have.
pub fn servos_of(device: &DeviceConfig, plant: &Plant) -> Result<Vec<Servo>, PlantError> {
    let servo = |actuator: &robot::ActuatorConfig| {
        let id = match actuator.hardware {
            HardwareId::Number(number) => u8::try_from(number).ok().filter(|id| *id <= 253),
            HardwareId::Name(_) => None,
        };
        let id = id.ok_or_else(|| {
            PlantError::new(format!("the hdr_id of '{}' is no id of a servo: 0 to 253", actuator.name))
        })?;
        let mut servo = Servo::new(id);
        servo.mount(plant.motor(&actuator.name)?, actuator.scale, actuator.offset);
        Ok(servo)
    };
    device.actuators.iter().map(servo).collect()
}
