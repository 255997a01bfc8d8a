//! A servo's control table, as bytes.

use protocol::dynamixel::{Access, Model, Register, address, status_error};

/// The bytes of a control table, with what may be written where.
pub(super) struct Memory {
    registers: Vec<Register>,
    bytes: [u8; address::END as usize],
}

impl Memory {
    /// The table of a model after a factory reset.
    pub(super) fn new(model: &Model) -> Memory {
        let mut memory = Memory { registers: model.registers().collect(), bytes: [0; address::END as usize] };
        memory.load(|_| true);
        for k in 0..address::END - address::INDIRECT_DATA {
            memory.put(address::INDIRECT_ADDRESS + 2 * k, 2, i64::from(address::INDIRECT_DATA + k));
        }
        memory
    }

    /// Gives initial values to the registers that `which` chooses.
    fn load(&mut self, which: impl Fn(&Register) -> bool) {
        for k in 0..self.registers.len() {
            let register = self.registers[k];
            if which(&register) {
                self.put(register.address, register.size, register.initial);
            }
        }
    }

    /// What a reboot leaves: the registers that do not outlive it have their initial values.
    pub(super) fn reboot(&mut self) {
        self.load(|register| register.access != Access::Locked);
    }

    /// A factory reset that keeps id and baud rate, as far as asked for.
    pub(super) fn reset(&mut self, keep_id: bool, keep_baud: bool) {
        self.load(|register| {
            !(keep_id && register.address == address::ID
                || keep_baud && register.address == address::BAUD_RATE)
        });
    }

    /// A register's value.
    pub(super) fn get(&self, address: u16) -> i64 {
        let size = self.registers.iter().find(|r| r.address == address).map_or(1, |r| r.size);
        self.number(address, size)
    }

    /// Sets a register; only its own bytes change.
    pub(super) fn set(&mut self, address: u16, value: i64) {
        let size = self.registers.iter().find(|r| r.address == address).map_or(1, |r| r.size);
        self.put(address, size, value);
    }

    fn number(&self, address: u16, size: u16) -> i64 {
        let bytes = &self.bytes[usize::from(address)..usize::from(address + size)];
        match *bytes {
            [a] => i64::from(a),
            [a, b] => i64::from(i16::from_le_bytes([a, b])),
            [a, b, c, d] => i64::from(i32::from_le_bytes([a, b, c, d])),
            _ => 0,
        }
    }

    fn put(&mut self, address: u16, size: u16, value: i64) {
        let (start, size) = (usize::from(address), usize::from(size));
        self.bytes[start..start + size].copy_from_slice(&value.to_le_bytes()[..size]);
    }

    /// Where the byte of an indirect data register is kept.
    fn resolve(&self, at: u16) -> u16 {
        if !(address::INDIRECT_DATA..address::END).contains(&at) {
            return at;
        }
        let entry = address::INDIRECT_ADDRESS + 2 * (at - address::INDIRECT_DATA);
        let to = u16::from_le_bytes([self.bytes[usize::from(entry)], self.bytes[usize::from(entry) + 1]]);
        if to < address::INDIRECT_ADDRESS { to } else { at }
    }

    /// Appends `length` bytes from `from` on.
    pub(super) fn read(&self, from: u16, length: u16, out: &mut Vec<u8>) -> Result<(), u8> {
        let end = from.checked_add(length).filter(|end| *end <= address::END && length > 0);
        let end = end.ok_or(status_error::DATA_RANGE)?;
        out.extend((from..end).map(|at| self.bytes[usize::from(self.resolve(at))]));
        Ok(())
    }

    /// Writes bytes from `from` on: all of them, or none and why.
    pub(super) fn write(&mut self, from: u16, data: &[u8], torque: bool) -> Result<(), u8> {
        let length = u16::try_from(data.len()).map_err(|_| status_error::DATA_LENGTH)?;
        if length == 0 || from.checked_add(length).is_none_or(|end| end > address::END) {
            return Err(status_error::DATA_RANGE);
        }
        let kept = self.bytes;
        for (at, &byte) in (from..).zip(data) {
            let to = self.resolve(at);
            self.bytes[usize::from(to)] = byte;
        }
        let outcome = (from..from + length).try_for_each(|at| self.check(self.resolve(at), torque));
        if outcome.is_err() {
            self.bytes = kept;
        }
        outcome
    }

    /// Whether the byte at this address may have been written with what its register holds now.
    fn check(&self, at: u16, torque: bool) -> Result<(), u8> {
        if (address::INDIRECT_ADDRESS..address::INDIRECT_DATA).contains(&at) {
            return if torque { Err(status_error::ACCESS) } else { Ok(()) };
        }
        let found = self.registers.iter().find(|r| (r.address..r.address + r.size).contains(&at));
        let Some(register) = found else { return Ok(()) };
        match register.access {
            Access::Read => return Err(status_error::ACCESS),
            Access::Locked if torque => return Err(status_error::ACCESS),
            Access::Locked | Access::Write => {}
        }
        let value = self.number(register.address, register.size);
        let [low, high] = self.limits(register);
        if (low..=high).contains(&value) {
            return Ok(());
        }
        let [least, most] = register.range;
        Err(if (least..=most).contains(&value) { status_error::DATA_LIMIT } else { status_error::DATA_RANGE })
    }

    /// What a register takes, limited by the registers that say so.
    fn limits(&self, register: &Register) -> [i64; 2] {
        let within = |limit: u16| {
            let limit = self.get(limit);
            [-limit, limit]
        };
        match register.address {
            address::GOAL_PWM => within(36),
            address::GOAL_CURRENT => within(address::CURRENT_LIMIT),
            address::GOAL_VELOCITY => within(address::VELOCITY_LIMIT),
            // Several turns are allowed in the modes that count them.
            address::GOAL_POSITION if matches!(self.get(address::OPERATING_MODE), 3) => {
                [self.get(address::MIN_POSITION), self.get(address::MAX_POSITION)]
            }
            address::GOAL_POSITION => [-1_048_575, 1_048_575],
            _ => register.range,
        }
    }
}
