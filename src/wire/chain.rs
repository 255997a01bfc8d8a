//! Simulated servos on one line, for any protocol.

use crate::device::{Device, Moment};
use crate::plant::{Plant, PlantError};
use robot::{DeviceConfig, HardwareId};

/// Silence after which an incomplete instruction is dropped \[s\]: with a damaged length the decoder would wait for bytes forever.
const GAP: f64 = 0.01;

/// What an instruction asks for; a read has an address and a number of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Asked {
    /// An answer, if the servo exists.
    Ping,
    /// To read bytes.
    Read(u16, u16),
    /// To write bytes.
    Write(u16, Vec<u8>),
    /// To write bytes at the next [`Asked::Action`].
    Register(u16, Vec<u8>),
    /// To write the registered bytes.
    Action,
    /// To restart.
    Reboot,
    /// To restore the factory settings; the byte says which.
    FactoryReset(u8),
    /// Nothing: it is acknowledged only.
    Nothing,
    /// To read several servos: id, address and number of bytes of each.
    ReadEach(Vec<(u8, u16, u16)>),
    /// To read the same bytes of several servos by one packet: address, number of bytes, ids.
    ReadTogether(u16, u16, Vec<u8>),
    /// To write to several servos: id, address and bytes of each.
    WriteEach(Vec<(u8, u16, Vec<u8>)>),
    /// An unknown instruction.
    Unknown,
}

/// A decoded instruction.
pub struct Instruction {
    /// The id of a servo, or [`Member::BROADCAST`].
    pub id: u8,
    /// Its request.
    pub asked: Asked,
}

/// An answer, and its delay.
pub struct Answer {
    /// Delay after the previous message \[s\].
    pub delay: f64,
    /// Its packet.
    pub bytes: Vec<u8>,
}

/// A servo on a line.
pub trait Member: Send + Sized {
    /// Finds packets among bytes.
    type Decoder: Default + Send;
    /// The id to which all servos listen.
    const BROADCAST: u8 = 0xFE;
    /// The largest id of a servo.
    const LARGEST_ID: u8;
    /// The error byte for an unknown instruction; `None` if there is no answer.
    const UNKNOWN: Option<u8>;

    /// Takes received bytes, and returns the instructions that are complete.
    fn instructions(decoder: &mut Self::Decoder, bytes: &[u8]) -> Vec<Instruction>;
    /// The packet of an answer; `None` for more data than a packet can have.
    fn encode(id: u8, error: u8, data: &[u8]) -> Option<Vec<u8>>;

    /// Its id.
    fn id(&self) -> u8;
    /// Whether it receives and answers at `now` \[s\].
    fn listens(&self, now: f64) -> bool;
    /// An instruction to any servo arrived at `now` \[s\].
    fn hear(&mut self, _now: f64) {}
    /// Seconds between an instruction and its answer.
    fn return_delay(&self) -> f64 {
        0.0
    }
    /// Whether it answers instructions of a level: pings (0), reads (1), all others (2).
    fn answers(&self, _level: i64) -> bool {
        true
    }
    /// Whether it answers an instruction that reads several servos.
    fn reads_in_bulk(&self) -> bool {
        true
    }
    /// The bits that hardware errors add to the error byte.
    fn alarm(&self) -> u8;
    /// Parameters of its answer to a ping.
    fn identity(&self) -> Vec<u8> {
        Vec::new()
    }
    /// Appends `length` bytes of its table to `out`.
    ///
    /// # Errors
    /// The error byte of a refusal.
    fn read(&mut self, plant: &Plant, from: u16, length: u16, out: &mut Vec<u8>) -> Result<(), u8>;
    /// Writes bytes to its table.
    ///
    /// # Errors
    /// The error byte of a refusal.
    fn write(&mut self, plant: &Plant, from: u16, data: &[u8]) -> Result<(), u8>;
    /// Registers a write for later, or none; returns the one registered before.
    fn keep(&mut self, write: Option<(u16, Vec<u8>)>) -> Option<(u16, Vec<u8>)>;
    /// Restarts.
    fn reboot(&mut self, _now: f64) -> Result<(), u8> {
        Self::UNKNOWN.map_or(Ok(()), Err)
    }
    /// Restores the factory settings that `how` names.
    fn factory_reset(&mut self, _how: u8, _now: f64) -> Result<(), u8> {
        Self::UNKNOWN.map_or(Ok(()), Err)
    }
    /// The answer of the servos in `ids` to a read, in one packet.
    fn together(_: &mut Bus<Self>, _: &Plant, _from: u16, _length: u16, _ids: &[u8]) -> Vec<Answer> {
        Vec::new()
    }
    /// Drives the motor during the next time step, of `dt` seconds.
    fn tick(&mut self, plant: &mut Plant, now: f64, dt: f64);
    /// Switches its power.
    fn set_powered(&mut self, powered: bool);
}

/// Servos on one line: each receives everything, and one sends at a time.
pub struct Bus<S: Member> {
    servos: Vec<S>,
    decoder: S::Decoder,
    echo: bool,
    /// Duration of a byte \[s\], for successive answers; the link adds the duration of each message itself.
    byte: f64,
    time: f64,
    /// Time of the last received bytes \[s\].
    heard: f64,
}

impl<S: Member> Bus<S> {
    /// Servos whose successive answers are sent at the same time; see [`Bus::with_baud`].
    pub fn new(servos: Vec<S>) -> Bus<S> {
        Bus { servos, decoder: S::Decoder::default(), echo: false, byte: 0.0, time: 0.0, heard: 0.0 }
    }

    /// Sends the answers to a sync read one after the other at this baud rate; the link has a baud rate of its own.
    #[must_use]
    pub fn with_baud(mut self, baud: f64) -> Bus<S> {
        self.byte = 10.0 / baud;
        self
    }

    /// Echoes received bytes, as half-duplex converters that do not switch their receiver off do; needs [`Bus::with_baud`].
    #[must_use]
    pub fn with_echo(mut self, echo: bool) -> Bus<S> {
        self.echo = echo;
        self
    }

    /// The servos.
    pub fn servos_mut(&mut self) -> &mut [S] {
        &mut self.servos
    }

    /// Servos that listen, in order of their ids.
    pub(crate) fn listening(&mut self, id: u8) -> Vec<&mut S> {
        let now = self.time;
        let all = id == S::BROADCAST;
        let servos = self.servos.iter_mut();
        let mut found: Vec<_> =
            servos.filter(|servo| servo.listens(now) && (all || servo.id() == id)).collect();
        found.sort_by_key(|servo| servo.id());
        found
    }

    /// Calls `act` on every servo with the id `id` and returns their answers; those of several servos with one id collide.
    fn each(
        &mut self,
        id: u8,
        level: i64,
        mut act: impl FnMut(&mut S, &mut Vec<u8>) -> Result<(), u8>,
    ) -> Vec<Answer> {
        let mut answers = Vec::new();
        for servo in self.listening(id) {
            let mut data = Vec::new();
            let error = act(servo, &mut data).err().unwrap_or(0);
            if error != 0 {
                data.clear();
            }
            if servo.answers(level) {
                let bytes = S::encode(servo.id(), error | servo.alarm(), &data);
                answers.extend(bytes.map(|bytes| Answer { delay: servo.return_delay(), bytes }));
            }
        }
        if id != S::BROADCAST {
            collide(&mut answers);
        }
        answers
    }

    /// Executes an instruction.
    fn follow(&mut self, plant: &Plant, instruction: &Instruction) -> Vec<Answer> {
        let (id, now) = (instruction.id, self.time);
        let answers = match &instruction.asked {
            Asked::Ping => {
                return self.each(id, 0, |servo, out| {
                    out.extend(servo.identity());
                    Ok(())
                });
            }
            Asked::ReadEach(reads) => {
                let read = |&(id, from, length): &(u8, u16, u16)| {
                    let known = self.listening(id).iter().all(|servo| servo.reads_in_bulk());
                    if known {
                        self.each(id, 1, |servo, out| servo.read(plant, from, length, out))
                    } else {
                        Vec::new()
                    }
                };
                return reads.iter().flat_map(read).collect();
            }
            Asked::ReadTogether(from, length, ids) => return S::together(self, plant, *from, *length, ids),
            Asked::WriteEach(writes) => {
                for (id, from, data) in writes {
                    self.each(*id, 2, |servo, _| servo.write(plant, *from, data));
                }
                return Vec::new();
            }
            Asked::Read(from, length) => {
                self.each(id, 1, |servo, out| servo.read(plant, *from, *length, out))
            }
            Asked::Write(from, data) => self.each(id, 2, |servo, _| servo.write(plant, *from, data)),
            Asked::Register(from, data) => self.each(id, 2, |servo, _| {
                servo.keep(Some((*from, data.clone())));
                Ok(())
            }),
            Asked::Action => self.each(id, 2, |servo, _| match servo.keep(None) {
                Some((from, data)) => servo.write(plant, from, &data),
                None => S::UNKNOWN.map_or(Ok(()), Err),
            }),
            Asked::Reboot => self.each(id, 2, |servo, _| servo.reboot(now)),
            Asked::FactoryReset(how) => self.each(id, 2, |servo, _| servo.factory_reset(*how, now)),
            Asked::Nothing => self.each(id, 2, |_, _| Ok(())),
            Asked::Unknown => match S::UNKNOWN {
                Some(error) => self.each(id, 2, |_, _| Err(error)),
                None => Vec::new(),
            },
        };
        if id == S::BROADCAST { Vec::new() } else { answers }
    }
}

impl<S: Member> Device for Bus<S> {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        if moment.time - self.heard > GAP {
            self.decoder = S::Decoder::default();
        }
        (self.heard, self.time) = (moment.time, moment.time);
        if self.echo {
            // Each byte comes back while it is sent, and the link takes its time once more.
            let sent = bytes.len() as f64 * self.byte;
            moment.outbox.send(channel, moment.time - sent, bytes.to_vec());
        }
        for instruction in S::instructions(&mut self.decoder, bytes) {
            self.servos.iter_mut().for_each(|servo| servo.hear(moment.time));
            let mut due = moment.time;
            for Answer { delay, bytes } in self.follow(moment.plant, &instruction) {
                due += delay;
                let length = bytes.len() as f64;
                moment.outbox.send(channel, due, bytes);
                due += length * self.byte;
            }
        }
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        self.time = moment.time;
        let dt = moment.plant.model().opt.timestep;
        self.servos.iter_mut().for_each(|servo| servo.tick(moment.plant, moment.time, dt));
    }

    fn stop_button(&mut self, pressed: bool) {
        // Servos have no stop button; the robot's cuts their power.
        self.servos.iter_mut().for_each(|servo| servo.set_powered(!pressed));
    }
}

/// Merges answers that are sent at the same time: a bit is 0 where any of them is.
fn collide(answers: &mut Vec<Answer>) {
    while answers.len() > 1 {
        let Some(other) = answers.pop() else { return };
        answers[0].bytes.iter_mut().zip(other.bytes).for_each(|(a, b)| *a &= b);
        answers[0].delay = answers[0].delay.max(other.delay);
    }
}

/// A servo for every actuator of a device, which `mount` puts on the motor of the same name, with the actuator's scale and
/// offset.
///
/// # Errors
/// An actuator that the plant lacks, or an id outside the range.
pub(crate) fn servos_of<S: Member>(
    device: &DeviceConfig,
    plant: &Plant,
    make: impl Fn(u8) -> S,
    mount: fn(&mut S, usize, f64, f64),
) -> Result<Vec<S>, PlantError> {
    let servo = |actuator: &robot::ActuatorConfig| {
        let id = match actuator.hardware {
            HardwareId::Number(number) => u8::try_from(number).ok().filter(|id| *id <= S::LARGEST_ID),
            HardwareId::Name(_) => None,
        };
        let id = id.ok_or_else(|| {
            let (name, largest) = (&actuator.name, S::LARGEST_ID);
            PlantError::new(format!(
                "the hdr_id of '{name}' is not the id of a servo; ids are from 0 to {largest}"
            ))
        })?;
        let mut servo = make(id);
        mount(&mut servo, plant.motor(&actuator.name)?, actuator.scale, actuator.offset);
        Ok(servo)
    };
    device.actuators.iter().map(servo).collect()
}

/// Instructions of protocol 1.0, which several makes use.
pub(crate) mod protocol_1 {
    use super::{Asked, Instruction};
    use protocol::dynamixel::v1::{Decoder, encode, instruction};

    /// The packet of an answer; `None` for more data than a packet can have.
    pub(crate) fn answer(id: u8, error: u8, data: &[u8]) -> Option<Vec<u8>> {
        let mut bytes = Vec::new();
        encode(&mut bytes, id, error, &[data]).is_ok().then_some(bytes)
    }

    /// Takes received bytes, and returns the complete instructions, for servos that support the sync read or the bulk read.
    pub(crate) fn instructions(
        decoder: &mut Decoder,
        bytes: &[u8],
        sync: bool,
        bulk: bool,
    ) -> Vec<Instruction> {
        decoder.push(bytes);
        let mut all = Vec::new();
        while let Some(packet) = decoder.next_packet() {
            let asked = match (packet.code, packet.parameters) {
                (instruction::PING, _) => Asked::Ping,
                (instruction::READ, [from, count]) => Asked::Read((*from).into(), (*count).into()),
                (instruction::WRITE, [from, data @ ..]) => Asked::Write((*from).into(), data.to_vec()),
                (instruction::REG_WRITE, [from, data @ ..]) => Asked::Register((*from).into(), data.to_vec()),
                (instruction::ACTION, _) => Asked::Action,
                (instruction::FACTORY_RESET, []) => Asked::FactoryReset(0xFF),
                (instruction::SYNC_READ, [from, count, ids @ ..]) if sync => {
                    let read = |id: &u8| (*id, (*from).into(), (*count).into());
                    Asked::ReadEach(ids.iter().map(read).collect())
                }
                (instruction::BULK_READ, [0, entries @ ..]) if bulk => {
                    let read = |entry: &[u8]| (entry[1], entry[2].into(), entry[0].into());
                    Asked::ReadEach(entries.chunks_exact(3).map(read).collect())
                }
                (instruction::SYNC_WRITE, [from, count, data @ ..]) => {
                    let write = |entry: &[u8]| (entry[0], (*from).into(), entry[1..].to_vec());
                    Asked::WriteEach(data.chunks_exact(usize::from(*count) + 1).map(write).collect())
                }
                _ => Asked::Unknown,
            };
            all.push(Instruction { id: packet.id, asked });
        }
        all
    }
}
