//! A bus of servos that share one line.

use super::servo::Servo;
use crate::device::{Device, Moment};
use protocol::crc;
use protocol::dynamixel::{BROADCAST, Decoder, encode, instruction, status_error};

/// Silence after which what was heard of an instruction is forgotten \[s\]: a damaged length would wait for bytes for ever.
const GAP: f64 = 0.01;

/// Servos on one line: each hears everything, and one speaks at a time.
pub struct Bus {
    servos: Vec<Servo>,
    decoder: Decoder,
    echo: bool,
    /// Seconds a byte takes, for answers that follow each other; the link adds the time of the message itself.
    byte: f64,
    time: f64,
    /// When bytes last came \[s\].
    heard: f64,
}

/// An answer under way: who says what, after which delay.
struct Answer {
    delay: f64,
    bytes: Vec<u8>,
}

impl Bus {
    /// Servos whose answers follow each other at once.
    pub fn new(servos: Vec<Servo>) -> Bus {
        Bus { servos, decoder: Decoder::default(), echo: false, byte: 0.0, time: 0.0, heard: 0.0 }
    }

    /// Lets the answers to a sync read follow each other at this baud rate; the link itself is told separately.
    #[must_use]
    pub fn with_baud(mut self, baud: f64) -> Bus {
        self.byte = 10.0 / baud;
        self
    }

    /// Returns to the driver what it sends, as converters to two wires do that do not switch their receiver off.
    #[must_use]
    pub fn with_echo(mut self, echo: bool) -> Bus {
        self.echo = echo;
        self
    }

    /// The servos.
    pub fn servos_mut(&mut self) -> &mut [Servo] {
        &mut self.servos
    }

    /// Servos that listen, in order of their ids.
    fn listening(&mut self, id: u8) -> Vec<usize> {
        let now = self.time;
        let all = id == BROADCAST;
        let mut found: Vec<_> = (0..self.servos.len())
            .filter(|k| self.servos[*k].listens(now) && (all || self.servos[*k].id() == id))
            .collect();
        found.sort_by_key(|k| self.servos[*k].id());
        found
    }

    /// Lets every servo of `id` do something and answer: two with one id talk at the same time.
    fn each(
        &mut self,
        id: u8,
        level: i64,
        mut act: impl FnMut(&mut Servo, &mut Vec<u8>) -> Result<(), u8>,
    ) -> Vec<Answer> {
        let mut answers = Vec::new();
        for k in self.listening(id) {
            let servo = &mut self.servos[k];
            let mut parameters = vec![0];
            if let Err(error) = act(servo, &mut parameters) {
                parameters.truncate(1);
                parameters[0] = error;
            }
            parameters[0] |= servo.alert();
            if !servo.answers(level) {
                continue;
            }
            let mut bytes = Vec::new();
            encode(&mut bytes, servo.id(), instruction::STATUS, &[&parameters]);
            answers.push(Answer { delay: servo.return_delay(), bytes });
        }
        if id != BROADCAST {
            collide(&mut answers);
        }
        answers
    }

    /// Answers of the servos in `ids` to a read of each, one after the other.
    fn read_each(&mut self, moment: &Moment<'_>, reads: impl Iterator<Item = (u8, u16, u16)>) -> Vec<Answer> {
        let mut answers = Vec::new();
        for (id, from, length) in reads {
            answers.extend(self.each(id, 1, |servo, out| servo.read(moment.plant, from, length, out)));
        }
        answers
    }

    /// One packet from all servos in `ids`: of each an error, its id, its data and the checksum of all before it.
    fn fast_read(&mut self, moment: &Moment<'_>, from: u16, length: u16, ids: &[u8]) -> Vec<Answer> {
        let mut packet = vec![0xFF, 0xFF, 0xFD, 0x00, BROADCAST];
        let size = 1 + ids.len() * (usize::from(length) + 4);
        packet.extend((size as u16).to_le_bytes());
        packet.push(instruction::STATUS);
        let mut delay = 0.0_f64;
        for (place, id) in ids.iter().enumerate() {
            let listening = self.listening(*id);
            // A servo that is not there leaves a gap: nobody after it knows that it is their turn.
            let Some(servo) = listening.first().map(|k| &mut self.servos[*k]) else { break };
            let mut data = Vec::new();
            let error = servo.read(moment.plant, from, length, &mut data).err().unwrap_or(0);
            data.resize(usize::from(length), 0);
            packet.push(error | servo.alert());
            packet.push(*id);
            packet.extend(data);
            delay = if place == 0 { servo.return_delay() } else { delay };
            let sum = crc::buypass(0, &packet);
            packet.extend(sum.to_le_bytes());
        }
        vec![Answer { delay, bytes: packet }]
    }

    /// Does what a packet asks for.
    fn follow(&mut self, moment: &mut Moment<'_>, id: u8, asked: u8, parameters: &[u8]) -> Vec<Answer> {
        let plant = &*moment.plant;
        let now = moment.time;
        let quiet = |answers: Vec<Answer>| if id == BROADCAST { Vec::new() } else { answers };
        match (asked, parameters) {
            (instruction::PING, _) => self.each(id, 0, |servo, out| {
                out.extend(servo.identity());
                Ok(())
            }),
            (instruction::READ, [a, b, n, m]) => {
                let (from, length) = (u16::from_le_bytes([*a, *b]), u16::from_le_bytes([*n, *m]));
                quiet(self.each(id, 1, |servo, out| servo.read(plant, from, length, out)))
            }
            (instruction::WRITE, [a, b, data @ ..]) => {
                let from = u16::from_le_bytes([*a, *b]);
                quiet(self.each(id, 2, |servo, _| servo.write(plant, from, data)))
            }
            (instruction::REG_WRITE, [a, b, data @ ..]) => {
                let from = u16::from_le_bytes([*a, *b]);
                quiet(self.each(id, 2, |servo, _| {
                    servo.register_write(from, data);
                    Ok(())
                }))
            }
            (instruction::ACTION, []) => quiet(self.each(id, 2, |servo, _| servo.action(plant))),
            (instruction::REBOOT, []) => quiet(self.each(id, 2, |servo, _| {
                servo.reboot(now);
                Ok(())
            })),
            (instruction::FACTORY_RESET, [how]) => {
                quiet(self.each(id, 2, |servo, _| servo.factory_reset(*how, now)))
            }
            (instruction::CLEAR, _) => quiet(self.each(id, 2, |_, _| Ok(()))),
            (instruction::SYNC_READ, [a, b, n, m, ids @ ..]) => {
                let (from, length) = (u16::from_le_bytes([*a, *b]), u16::from_le_bytes([*n, *m]));
                self.read_each(moment, ids.iter().map(|id| (*id, from, length)))
            }
            (instruction::FAST_SYNC_READ, [a, b, n, m, ids @ ..]) => {
                let (from, length) = (u16::from_le_bytes([*a, *b]), u16::from_le_bytes([*n, *m]));
                self.fast_read(moment, from, length, ids)
            }
            (instruction::BULK_READ, entries) => {
                let read =
                    |e: &[u8]| (e[0], u16::from_le_bytes([e[1], e[2]]), u16::from_le_bytes([e[3], e[4]]));
                self.read_each(moment, entries.chunks_exact(5).map(read))
            }
            (instruction::SYNC_WRITE, [a, b, n, m, data @ ..]) => {
                let (from, length) = (u16::from_le_bytes([*a, *b]), u16::from_le_bytes([*n, *m]));
                for entry in data.chunks_exact(usize::from(length) + 1) {
                    self.each(entry[0], 2, |servo, _| servo.write(plant, from, &entry[1..]));
                }
                Vec::new()
            }
            (instruction::BULK_WRITE, mut rest) => {
                while let [id, a, b, n, m, data @ ..] = rest {
                    let (from, length) =
                        (u16::from_le_bytes([*a, *b]), usize::from(u16::from_le_bytes([*n, *m])));
                    let Some((data, left)) = data.split_at_checked(length) else { break };
                    self.each(*id, 2, |servo, _| servo.write(plant, from, data));
                    rest = left;
                }
                Vec::new()
            }
            _ => quiet(self.each(id, 2, |_, _| Err(status_error::INSTRUCTION))),
        }
    }

    /// Sends answers one after the other.
    fn say(&self, moment: &mut Moment<'_>, answers: Vec<Answer>) {
        let mut due = moment.time;
        for Answer { delay, bytes } in answers {
            due += delay;
            let length = bytes.len() as f64;
            moment.outbox.send(0, due, bytes);
            due += length * self.byte;
        }
    }
}

impl Device for Bus {
    fn receive(&mut self, moment: &mut Moment<'_>, _channel: usize, bytes: &[u8]) {
        if moment.time - self.heard > GAP {
            self.decoder.clear();
        }
        self.heard = moment.time;
        self.time = moment.time;
        if self.echo {
            moment.outbox.send(0, moment.time, bytes.to_vec());
        }
        let mut decoder = std::mem::take(&mut self.decoder);
        decoder.push(bytes);
        while let Some(packet) = decoder.next_packet() {
            // Of a packet with a wrong checksum nobody can say to whom it was; servos stay silent.
            let Ok(packet) = packet else { continue };
            // What other servos say is not for these.
            if packet.instruction == instruction::STATUS {
                continue;
            }
            self.servos.iter_mut().for_each(|servo| servo.hear(moment.time));
            let answers = self.follow(moment, packet.id, packet.instruction, packet.parameters);
            self.say(moment, answers);
        }
        self.decoder = decoder;
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        self.time = moment.time;
        let dt = moment.plant.model().opt.timestep;
        self.servos.iter_mut().for_each(|servo| servo.tick(moment.plant, moment.time, dt));
    }

    fn stop_button(&mut self, pressed: bool) {
        // Servos have no stop button of their own: it cuts their power.
        self.servos.iter_mut().for_each(|servo| servo.set_powered(!pressed));
    }
}

/// Two that speak at once pull the line low wherever either does.
fn collide(answers: &mut Vec<Answer>) {
    while answers.len() > 1 {
        let Some(other) = answers.pop() else { return };
        answers[0].bytes.iter_mut().zip(other.bytes).for_each(|(a, b)| *a &= b);
        answers[0].delay = answers[0].delay.max(other.delay);
    }
}
