//! Dynamixel servos with protocol 1.0: AX, RX, and MX with older firmware.

use crate::chain::{Instruction, Member, protocol_1};
use crate::plant::{Drive, Plant};
use crate::profile::Profile;
use crate::shaft::Shaft;
use protocol::dynamixel::v1::{Decoder, Model, TABLE, address, error};
use protocol::servo::{Cell, Sign};

/// Servos with protocol 1.0 on one line.
pub type Bus = crate::chain::Bus<Servo>;

/// Largest share of torque, load or output.
const FULL: f64 = 1023.0;
/// Numbers whose sign is bit 10.
const SPEED: Cell = Cell::new(address::MOVING_SPEED, 2).with_sign(Sign::Bit(10));

/// A servo, on the shaft of a motor of the plant or on none. Of the torque limit only 0, no torque, is simulated.
pub struct Servo {
    model: &'static Model,
    table: [u8; TABLE],
    shaft: Option<Shaft>,
    profile: Profile,
    registered: Option<(u16, Vec<u8>)>,
    alarm: u8,
    powered: bool,
}

impl Servo {
    /// A servo as it leaves the factory, with this id.
    pub fn new(model: &'static Model, id: u8) -> Servo {
        let mut servo = Servo {
            model,
            table: [0; TABLE],
            shaft: None,
            profile: Profile::default(),
            registered: None,
            alarm: 0,
            powered: true,
        };
        servo.forget(id);
        servo.restart();
        servo
    }

    /// Puts it on the shaft of a motor of the plant: angle \[rad\] = joint × scale + offset, where 0 is position 0.
    pub fn mount(&mut self, motor: usize, scale: f64, offset: f64) {
        self.shaft = Some(Shaft { motor, scale, offset });
    }

    /// Sets a register by hand, whatever its access: as an earlier user left it.
    pub fn set_register(&mut self, address: u16, value: u16) {
        let [low, high] = value.to_le_bytes();
        let at = usize::from(address);
        self.table[at] = low;
        if wide(address) {
            self.table[at + 1] = high;
        }
    }

    /// A register's value.
    pub fn register(&self, address: u16) -> u16 {
        let at = usize::from(address);
        let high = if wide(address) { self.table[at + 1] } else { 0 };
        u16::from_le_bytes([self.table[at], high])
    }

    /// Sets its hardware errors, 0 for none; those in the register "Shutdown" switch the torque off until
    /// the torque limit is written again.
    pub fn set_alarm(&mut self, errors: u8) {
        self.alarm = errors;
        if errors & self.table[usize::from(address::SHUTDOWN)] != 0 {
            self.set_register(address::TORQUE_LIMIT, 0);
        }
    }

    /// Warms it up to a temperature \[°C\]; above its limit it shuts down.
    pub fn heat(&mut self, celsius: u8) {
        self.table[usize::from(address::PRESENT_TEMPERATURE)] = celsius;
        let hot = u16::from(celsius) > self.register(address::TEMPERATURE_LIMIT);
        self.set_alarm(if hot { self.alarm | error::HEAT } else { self.alarm & !error::HEAT });
    }

    /// Restores the factory values of the non-volatile registers.
    fn forget(&mut self, id: u8) {
        for (register, value) in [
            (address::MODEL_NUMBER, self.model.kind.number),
            (address::FIRMWARE, 24),
            (address::ID, id.into()),
            (address::BAUD_RATE, 1),
            (address::RETURN_DELAY, 250),
            (address::CW_LIMIT, 0),
            (address::CCW_LIMIT, self.model.kind.last as u16),
            (address::TEMPERATURE_LIMIT, if self.model.encoder { 80 } else { 70 }),
            (address::MIN_VOLTAGE, 60),
            (address::MAX_VOLTAGE, if self.model.encoder { 160 } else { 140 }),
            (address::MAX_TORQUE, 1023),
            (address::STATUS_RETURN, 2),
            (address::ALARM_LED, 36),
            (address::SHUTDOWN, 36),
        ] {
            self.set_register(register, value);
        }
    }

    /// Restores the initial values of the volatile registers.
    fn restart(&mut self) {
        self.table[usize::from(address::TORQUE_ENABLE)..].fill(0);
        self.set_register(address::TORQUE_LIMIT, self.register(address::MAX_TORQUE));
        self.set_register(address::PRESENT_VOLTAGE, 111);
        self.set_register(address::PRESENT_TEMPERATURE, 30);
    }

    fn torque(&self) -> bool {
        self.powered
            && self.table[usize::from(address::TORQUE_ENABLE)] == 1
            && self.register(address::TORQUE_LIMIT) > 0
    }

    /// Whether it is in wheel mode: both angle limits are 0.
    fn wheel(&self) -> bool {
        self.register(address::CW_LIMIT) == 0 && self.register(address::CCW_LIMIT) == 0
    }

    /// Checks the value of a register.
    ///
    /// # Errors
    /// The error byte for a value that is not allowed.
    fn check(&self, register: u16) -> Result<(), u8> {
        let value = self.register(register);
        let [low, high] = [address::CW_LIMIT, address::CCW_LIMIT].map(|limit| self.register(limit));
        let largest = match register {
            address::GOAL_POSITION if self.wheel() => return Ok(()),
            address::GOAL_POSITION if !(low..=high).contains(&value) => return Err(error::ANGLE),
            address::CW_LIMIT | address::CCW_LIMIT => self.model.kind.last as u16,
            address::MOVING_SPEED => 2047,
            address::MAX_TORQUE | address::TORQUE_LIMIT | address::PUNCH => 1023,
            address::TORQUE_ENABLE | address::LOCK => 1,
            address::STATUS_RETURN => 2,
            address::ID => 253,
            _ => return Ok(()),
        };
        if value > largest { Err(error::RANGE) } else { Ok(()) }
    }

    /// The drive of the motor for its goals.
    fn drive(&mut self, scale: f64, dt: f64) -> Drive {
        let kind = &self.model.kind;
        let speed = SPEED.decode(&self.register(address::MOVING_SPEED).to_le_bytes()) as f64;
        if self.wheel() {
            return if self.model.encoder {
                Drive::Velocity(speed * kind.velocity / scale)
            } else {
                Drive::Effort(speed / FULL * self.model.stall * scale)
            };
        }
        let goal = f64::from(self.register(address::GOAL_POSITION));
        self.profile.advance(goal, speed.abs() * kind.velocity / kind.position, 0.0, dt);
        let angle = self.profile.position * kind.position;
        self.shaft.map_or(Drive::Off, |shaft| Drive::Control(shaft.joint(angle)))
    }

    /// Writes the measured quantities to their registers.
    fn measure(&mut self, plant: &Plant) {
        let Some(shaft) = self.shaft else { return };
        let kind = &self.model.kind;
        let position = (shaft.angle(plant) / kind.position).round();
        let last = kind.last as f64;
        // An encoder counts round and round; a potentiometer has an end.
        let position =
            if self.model.encoder { position.rem_euclid(last + 1.0) } else { position.clamp(0.0, last) };
        let signed = |number: f64| {
            let [low, high, ..] = SPEED.encode(number.round() as i64);
            u16::from_le_bytes([low, high])
        };
        let (speed, load) = (shaft.velocity(plant) / kind.velocity, shaft.effort(plant) / self.model.stall);
        self.set_register(address::PRESENT_POSITION, position as u16);
        self.set_register(address::PRESENT_SPEED, signed(speed));
        self.set_register(address::PRESENT_LOAD, signed(load * FULL));
    }
}

/// Whether the register at an address has two bytes.
fn wide(register: u16) -> bool {
    matches!(
        register,
        address::MODEL_NUMBER
            | address::CW_LIMIT
            | address::CCW_LIMIT
            | address::MAX_TORQUE
            | address::GOAL_POSITION..=address::PRESENT_LOAD | address::PUNCH
    )
}

impl Member for Servo {
    type Decoder = Decoder;
    const LARGEST_ID: u8 = 253;
    const UNKNOWN: Option<u8> = Some(error::INSTRUCTION);

    fn instructions(decoder: &mut Decoder, bytes: &[u8]) -> Vec<Instruction> {
        protocol_1::instructions(decoder, bytes, false, true)
    }

    fn encode(id: u8, error: u8, data: &[u8]) -> Option<Vec<u8>> {
        protocol_1::answer(id, error, data)
    }

    fn id(&self) -> u8 {
        self.table[usize::from(address::ID)]
    }

    fn listens(&self, _now: f64) -> bool {
        self.powered
    }

    fn return_delay(&self) -> f64 {
        f64::from(self.register(address::RETURN_DELAY)) * Model::DELAY_UNIT
    }

    fn answers(&self, level: i64) -> bool {
        i64::from(self.register(address::STATUS_RETURN)) >= level
    }

    fn alarm(&self) -> u8 {
        self.alarm
    }

    fn reads_in_bulk(&self) -> bool {
        self.model.encoder
    }

    fn read(&mut self, plant: &Plant, from: u16, length: u16, out: &mut Vec<u8>) -> Result<(), u8> {
        self.measure(plant);
        let from = usize::from(from);
        let bytes = self.table.get(from..from + usize::from(length)).ok_or(error::RANGE)?;
        out.extend_from_slice(bytes);
        Ok(())
    }

    /// Writes all bytes, or none on an error. Non-volatile registers do not change while torque is on or while they are locked; the answer
    /// of a real servo in this case is not documented.
    fn write(&mut self, plant: &Plant, from: u16, data: &[u8]) -> Result<(), u8> {
        let torque = self.torque();
        let kept = self.table;
        let lasting = self.register(address::TORQUE_ENABLE) == 0 && self.register(address::LOCK) == 0;
        let end = usize::from(from) + data.len();
        if data.is_empty() || end > TABLE {
            return Err(error::RANGE);
        }
        for (at, byte) in (from..).zip(data) {
            let allowed = match at {
                address::MODEL_NUMBER..address::ID | address::PRESENT_POSITION..=address::MOVING => false,
                address::LOCK => *byte != 0,
                _ => at >= address::TORQUE_ENABLE || lasting,
            };
            if allowed {
                self.table[usize::from(at)] = *byte;
            }
        }
        // A register of two bytes begins at an even address.
        let outcome = (from & !1..end as u16).try_for_each(|register| self.check(register));
        if outcome.is_err() {
            self.table = kept;
            return outcome;
        }
        if !torque && self.torque() {
            self.measure(plant);
            self.profile = Profile::at(f64::from(self.register(address::PRESENT_POSITION)));
        }
        Ok(())
    }

    fn keep(&mut self, write: Option<(u16, Vec<u8>)>) -> Option<(u16, Vec<u8>)> {
        self.set_register(address::REGISTERED, u16::from(write.is_some()));
        std::mem::replace(&mut self.registered, write)
    }

    fn factory_reset(&mut self, _how: u8, _now: f64) -> Result<(), u8> {
        self.forget(1);
        self.restart();
        Ok(())
    }

    fn tick(&mut self, plant: &mut Plant, _now: f64, dt: f64) {
        let Some(shaft) = self.shaft else { return };
        let drive = if self.torque() { self.drive(shaft.scale, dt) } else { Drive::Off };
        let goal = f64::from(self.register(address::GOAL_POSITION));
        let moving = self.torque() && !self.wheel() && !self.profile.done(goal);
        self.set_register(address::MOVING, u16::from(moving));
        plant.drive(shaft.motor, drive);
    }

    fn set_powered(&mut self, powered: bool) {
        if powered && !self.powered {
            self.restart();
        }
        self.powered = powered;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bench, Carries, VirtualPort};
    use protocol::Port;
    use protocol::dynamixel::v1::{BROADCAST, encode, instruction, model};
    use std::sync::{Arc, Mutex};

    const BAUD: f64 = 1e6;

    /// An AX-12A with id 1 and two MX-28 with ids 2 and 3, each with a flywheel, prepared.
    fn line(prepare: impl FnOnce(&mut [Servo])) -> VirtualPort {
        let hinge = |name| {
            format!(
                "<body><joint name='{name}' damping='.1' armature='.05'/><geom size='.1' contype='0' conaffinity='0'/></body>"
            )
        };
        let motor = |name| format!("<position name='{name}' joint='{name}' kp='20' kv='1'/>");
        let text = format!(
            "<mujoco><option gravity='0 0 0'/><worldbody>{}</worldbody><actuator>{}</actuator></mujoco>",
            ["a", "b", "c"].map(hinge).concat(),
            ["a", "b", "c"].map(motor).concat()
        );
        let plant = Plant::new(robohive_mjcf::load_str(&text).unwrap().model).unwrap();
        let mut servos =
            [("AX-12A", 1, "a"), ("MX-28", 2, "b"), ("MX-28", 3, "c")].map(|(kind, id, motor)| {
                let mut servo = Servo::new(model(kind).unwrap(), id);
                servo.mount(plant.motor(motor).unwrap(), 1.0, 512.0 * servo.model.kind.position);
                servo
            });
        prepare(&mut servos);
        let mut bench = Bench::new(plant);
        let bus = Bus::new(servos.into()).with_baud(BAUD);
        let link = bench.connect(Box::new(bus), Carries::serial(BAUD));
        VirtualPort::new(Arc::new(Mutex::new(bench)), link)
    }

    /// Every answer: id, error, data.
    fn ask(port: &mut VirtualPort, id: u8, code: u8, parameters: &[u8]) -> Vec<(u8, u8, Vec<u8>)> {
        let mut bytes = Vec::new();
        encode(&mut bytes, id, code, &[parameters]).unwrap();
        port.send(&bytes).unwrap();
        let (mut decoder, mut buffer) = (Decoder::default(), [0; 64]);
        loop {
            match port.receive(&mut buffer, 0.01).unwrap() {
                0 => break,
                count => decoder.push(&buffer[..count]),
            }
        }
        std::iter::from_fn(|| decoder.next_packet().map(|p| (p.id, p.code, p.parameters.to_vec()))).collect()
    }

    #[test]
    fn registers_are_written_within_their_ranges_and_locked_by_torque() {
        let mut port = line(|_| {});
        let done = |error| vec![(1, error, vec![])];
        // 300 to 700 of 1023; then torque, and a goal beyond the limit.
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[6, 0x2C, 1, 0xBC, 2]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[30, 0x58, 2]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[24, 1]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[30, 0xBD, 2]), done(error::ANGLE));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[32, 0, 8]), done(error::RANGE));
        assert_eq!(ask(&mut port, 1, 0x77, &[]), done(error::INSTRUCTION));
        assert_eq!(ask(&mut port, 1, instruction::ACTION, &[]), done(error::INSTRUCTION));
        assert_eq!(ask(&mut port, 1, instruction::READ, &[48, 3]), done(error::RANGE));
        // The limit is locked, what is measured is not written, and the goal is that of before.
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[8, 0xFF, 3]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[36, 0, 0]), done(0));
        port.wait(3.0);
        assert_eq!(ask(&mut port, 1, instruction::READ, &[8, 2]), [(1, 0, vec![0xBC, 2])]);
        assert_eq!(ask(&mut port, 1, instruction::READ, &[30, 2]), [(1, 0, vec![0x58, 2])]);
        assert_eq!(ask(&mut port, 1, instruction::READ, &[36, 2]), [(1, 0, vec![0x58, 2])]);
        assert_eq!(ask(&mut port, 1, instruction::REG_WRITE, &[24, 0]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::READ, &[44, 1]), [(1, 0, vec![1])]);
        assert_eq!(ask(&mut port, BROADCAST, instruction::ACTION, &[]), []);
        assert_eq!(ask(&mut port, 1, instruction::READ, &[24, 1]), [(1, 0, vec![0])]);
        // Locked until the next restart.
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[47, 1]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[47, 0]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::WRITE, &[8, 0xFF, 3]), done(0));
        assert_eq!(ask(&mut port, 1, instruction::READ, &[8, 2]), [(1, 0, vec![0xBC, 2])]);
    }

    #[test]
    fn it_goes_to_its_goal_at_its_moving_speed() {
        let mut port = line(|servos| servos[0].set_register(address::RETURN_DELAY, 0));
        // 100 units are 11.1 turns a minute, which are 227 positions a second.
        for (register, value) in [(30, 1000_u16), (32, 100)] {
            let [low, high] = value.to_le_bytes();
            ask(&mut port, 1, instruction::WRITE, &[register, low, high]);
        }
        ask(&mut port, 1, instruction::WRITE, &[24, 1]);
        let mut position = |wait: f64| {
            port.wait(wait);
            let [(_, 0, data)] = &ask(&mut port, 1, instruction::READ, &[36, 2])[..] else {
                panic!("an answer")
            };
            (port.now(), f64::from(u16::from_le_bytes([data[0], data[1]])))
        };
        let ((begun, from), (ended, to)) = (position(0.5), position(1.0));
        let speed = (to - from) / (ended - begun);
        assert!((speed - 227.3).abs() < 2.0, "{speed}");
        assert_eq!(position(3.0).1, 1000.0);
    }

    #[test]
    fn it_answers_as_late_and_as_seldom_as_it_is_told() {
        let mut port = line(|servos| servos[1].set_register(address::STATUS_RETURN, 1));
        let mut bytes = Vec::new();
        encode(&mut bytes, 1, instruction::PING, &[]).unwrap();
        port.send(&bytes).unwrap();
        let mut buffer = [0; 16];
        assert_eq!(port.receive(&mut buffer, 0.1).unwrap(), 6);
        // Six bytes there, the factory's 500 µs, six bytes back.
        assert!((port.now() - (6.0 * 10e-6 + 500e-6 + 6.0 * 10e-6)).abs() < 1e-9, "{}", port.now());
        assert_eq!(ask(&mut port, 2, instruction::WRITE, &[25, 1]), []);
        assert_eq!(ask(&mut port, 2, instruction::READ, &[25, 1]), [(2, 0, vec![1])]);
        assert_eq!(ask(&mut port, 2, instruction::WRITE, &[16, 0]), []);
        assert_eq!(ask(&mut port, 2, instruction::READ, &[25, 1]), []);
        assert_eq!(ask(&mut port, 2, instruction::PING, &[]), [(2, 0, vec![])]);
        assert_eq!(ask(&mut port, BROADCAST, instruction::WRITE, &[25, 0]), []);
    }

    #[test]
    fn an_mx_is_read_in_bulk_and_an_ax_is_not() {
        let mut port = line(|_| {});
        let read = ask(&mut port, BROADCAST, instruction::BULK_READ, &[0, 2, 2, 36, 1, 3, 43, 2, 1, 36]);
        assert_eq!(read, [(2, 0, vec![0, 2]), (3, 0, vec![30])]);
        // There is no sync read, and the answer to what all hear is silence.
        assert_eq!(ask(&mut port, BROADCAST, instruction::SYNC_READ, &[36, 2, 1, 2]), []);
    }

    #[test]
    fn heat_takes_the_torque_until_the_limit_is_written_again() {
        let mut port = line(|servos| {
            servos[0].set_register(address::TORQUE_ENABLE, 1);
            servos[0].heat(75);
        });
        let hot = |data: &[u8]| [(1, error::HEAT, data.to_vec())];
        assert_eq!(ask(&mut port, 1, instruction::READ, &[34, 2]), hot(&[0, 0]));
        assert_eq!(ask(&mut port, 1, instruction::READ, &[43, 1]), hot(&[75]));
        let mut servo = Servo::new(model("AX-12A").unwrap(), 1);
        servo.set_register(address::TORQUE_ENABLE, 1);
        assert!(servo.torque());
        servo.heat(75);
        assert!(!servo.torque());
        servo.heat(40);
        assert!(!servo.torque() && servo.alarm == 0);
        servo.set_register(address::TORQUE_LIMIT, 1023);
        assert!(servo.torque());
    }
}
