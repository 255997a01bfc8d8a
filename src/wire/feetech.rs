//! Feetech servos of the STS series on a bus.

use crate::chain::{Instruction, Member, protocol_1};
use crate::plant::{Drive, Plant};
use crate::profile::Profile;
use crate::shaft::Shaft;
use protocol::dynamixel::v1::Decoder;
use protocol::feetech::{ACCELERATION_UNIT, CURRENT_UNIT, STEP, STS3215, TABLE, address};
use protocol::servo::{Cell, Sign};

/// Servos on one line.
pub type Bus = crate::chain::Bus<Servo>;

/// Numbers whose sign is bit 15.
const SIGNED: Cell = Cell::new(0, 2).with_sign(Sign::Bit(15));
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
    registered: Option<(u16, Vec<u8>)>,
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

    fn signed(&self, at: u8) -> f64 {
        SIGNED.decode(&self.get(at).to_le_bytes()) as f64
    }

    fn set_signed(&mut self, at: u8, value: f64) {
        let [low, high, ..] = SIGNED.encode(value.round() as i64);
        self.set(at, u16::from_le_bytes([low, high]));
    }

    fn torque(&self) -> bool {
        self.powered && self.table[usize::from(address::TORQUE_ENABLE)] == 1
    }

    /// Writes the measured quantities to their registers.
    fn measure(&mut self, plant: &Plant) {
        let Some(shaft) = self.shaft else { return };
        let position = (shaft.angle(plant) / STEP).round().rem_euclid(4096.0);
        self.set(address::PRESENT_POSITION, position as u16);
        self.set_signed(address::PRESENT_VELOCITY, shaft.velocity(plant) / STEP);
        let current = shaft.effort(plant).abs() / TORQUE_CONSTANT / CURRENT_UNIT;
        self.set(address::PRESENT_CURRENT, current.round() as u16);
    }
}

impl Member for Servo {
    type Decoder = Decoder;
    const LARGEST_ID: u8 = 253;
    const UNKNOWN: Option<u8> = None;

    fn instructions(decoder: &mut Decoder, bytes: &[u8]) -> Vec<Instruction> {
        protocol_1::instructions(decoder, bytes, true, false)
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

    fn alarm(&self) -> u8 {
        self.table[usize::from(address::STATUS)]
    }

    fn keep(&mut self, write: Option<(u16, Vec<u8>)>) -> Option<(u16, Vec<u8>)> {
        std::mem::replace(&mut self.registered, write)
    }

    fn set_powered(&mut self, powered: bool) {
        if powered && !self.powered {
            self.restart();
        }
        self.powered = powered;
    }

    fn read(&mut self, plant: &Plant, from: u16, count: u16, out: &mut Vec<u8>) -> Result<(), u8> {
        self.measure(plant);
        let bytes = (usize::from(from)..usize::from(from) + usize::from(count)).map(|at| self.table.get(at));
        out.extend(bytes.map(|byte| byte.copied().unwrap_or(0)));
        Ok(())
    }

    /// Writes what may be written: registers below the torque switch while they are not locked, none that is measured.
    fn write(&mut self, plant: &Plant, from: u16, data: &[u8]) -> Result<(), u8> {
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
        Ok(())
    }

    fn tick(&mut self, plant: &mut Plant, _now: f64, dt: f64) {
        let goal = self.signed(address::GOAL_POSITION);
        let Some(shaft) = self.shaft else { return };
        let drive = match self.table[usize::from(address::MODE)] {
            _ if !self.torque() => Drive::Off,
            POSITION => {
                let low = f64::from(self.get(address::MIN_ANGLE));
                let goal = goal.clamp(low, f64::from(self.get(address::MAX_ANGLE)).max(low));
                let fastest = self.signed(address::GOAL_VELOCITY).abs();
                let steps = ACCELERATION_UNIT / STEP;
                let acceleration = f64::from(self.table[usize::from(address::ACCELERATION)]) * steps;
                self.profile.advance(goal, fastest, acceleration, dt);
                Drive::Control(shaft.joint(self.profile.position * STEP))
            }
            VELOCITY => Drive::Velocity(self.signed(address::GOAL_VELOCITY) * STEP / shaft.scale),
            _ => Drive::Off,
        };
        let moving = self.torque() && !self.profile.done(goal);
        self.table[usize::from(address::MOVING)] = u8::from(moving);
        plant.drive(shaft.motor, drive);
    }
}
