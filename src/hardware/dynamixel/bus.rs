//! Instructions to servos, and their answers.

use crate::serial_line::{RECEIVED, SerialLine};
use protocol::Port;
use protocol::dynamixel::{BROADCAST, Decoder, encode, hardware_error, instruction, status_error};
use robot::Fault;

/// Tries of an instruction to one servo that may be repeated.
const TRIES: usize = 3;

/// What a servo has answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Answer {
    /// The hardware has an error.
    pub(super) alert: bool,
}

/// The driver's side of a bus. Once it has sent its longest instruction, it allocates nothing.
pub(super) struct Bus {
    line: SerialLine,
    decoder: Decoder,
}

impl Bus {
    pub(super) fn new(port: Box<dyn Port>, baud: u32) -> Bus {
        Bus { line: SerialLine::new(port, baud), decoder: Decoder::with_room(RECEIVED) }
    }

    /// Sends an instruction. What an earlier one left behind is dropped.
    fn send(&mut self, id: u8, instruction: u8, parameters: &[&[u8]]) -> Result<(), Fault> {
        self.decoder.clear();
        self.line.send(|out| encode(out, id, instruction, parameters))
    }

    /// Waits for the next status packet, and gives it to `take` with its id, its error byte and its data.
    fn status<R>(
        &mut self,
        bytes: usize,
        mut take: impl FnMut(u8, u8, &[u8]) -> Option<R>,
    ) -> Result<R, Fault> {
        let Bus { line, decoder } = self;
        // Around its data an answer has eleven bytes, and more where these are stuffed.
        line.answer(bytes + 16, |_, came| {
            decoder.push(came);
            while let Some(packet) = decoder.next_packet() {
                // Damaged packets, and the echo of our own instruction, are skipped.
                let Ok(packet) = packet else { continue };
                if packet.instruction != instruction::STATUS {
                    continue;
                }
                let taken =
                    packet.parameters.split_first().and_then(|(error, data)| take(packet.id, *error, data));
                if taken.is_some() {
                    return taken;
                }
            }
            None
        })
    }

    /// Asks one servo until it answers, a few times.
    fn ask(
        &mut self,
        id: u8,
        instruction: u8,
        parameters: &[&[u8]],
        out: &mut [u8],
    ) -> Result<Answer, Fault> {
        let mut last = Fault::Stale(0);
        for _ in 0..TRIES {
            self.send(id, instruction, parameters)?;
            let expected = out.len();
            let answered = self.status(expected, |from, error, data| {
                let refused = error & !status_error::ALERT;
                if from != id || refused == 0 && data.len() != expected {
                    return None;
                }
                if refused == 0 {
                    out.copy_from_slice(data);
                }
                Some(error)
            });
            match answered {
                Ok(error) if error & !status_error::ALERT == 0 => {
                    return Ok(Answer { alert: error & status_error::ALERT != 0 });
                }
                // A servo that heard a damaged instruction says so; it is asked again.
                Ok(error) if error & !status_error::ALERT == status_error::CRC => {}
                Ok(error) => {
                    return Err(Fault::Refused(format!("servo {id}: {}", status_error::describe(error))));
                }
                Err(fault @ Fault::Stale(_)) => last = fault,
                Err(fault) => return Err(fault),
            }
        }
        Err(last)
    }

    /// Model number and firmware of a servo.
    pub(super) fn ping(&mut self, id: u8) -> Result<(u16, u8, Answer), Fault> {
        let mut data = [0; 3];
        let answer = self.ask(id, instruction::PING, &[], &mut data)?;
        Ok((u16::from_le_bytes([data[0], data[1]]), data[2], answer))
    }

    /// A register of one servo, sign extended.
    pub(super) fn read(&mut self, id: u8, address: u16, size: u16) -> Result<i64, Fault> {
        let mut data = [0; 4];
        let data = &mut data[..usize::from(size)];
        self.ask(id, instruction::READ, &[&address.to_le_bytes(), &size.to_le_bytes()], data)?;
        Ok(match *data {
            [a] => i64::from(a),
            [a, b] => i64::from(i16::from_le_bytes([a, b])),
            [a, b, c, d] => i64::from(i32::from_le_bytes([a, b, c, d])),
            _ => 0,
        })
    }

    /// Writes a register of one servo.
    pub(super) fn write(&mut self, id: u8, address: u16, size: u16, value: i64) -> Result<(), Fault> {
        let value = value.to_le_bytes();
        let parameters: [&[u8]; 2] = [&address.to_le_bytes(), &value[..usize::from(size)]];
        self.ask(id, instruction::WRITE, &parameters, &mut []).map(drop)
    }

    /// Restarts a servo; it is silent for a quarter of a second.
    pub(super) fn reboot(&mut self, id: u8) -> Result<(), Fault> {
        self.ask(id, instruction::REBOOT, &[], &mut []).map(drop)
    }

    /// What the hardware of a servo that alerts has.
    pub(super) fn trouble(&mut self, id: u8) -> Result<String, Fault> {
        let bits = self.read(id, protocol::dynamixel::address::HARDWARE_ERROR, 1)?;
        Ok(hardware_error::describe(bits as u8))
    }

    /// Writes the same register of several servos at once; none of them answers.
    pub(super) fn sync_write(
        &mut self,
        address: u16,
        size: u16,
        values: impl Iterator<Item = (u8, i64)>,
        scratch: &mut Vec<u8>,
    ) -> Result<(), Fault> {
        scratch.clear();
        for (id, value) in values {
            scratch.push(id);
            scratch.extend_from_slice(&value.to_le_bytes()[..usize::from(size)]);
        }
        let prefix = [address.to_le_bytes(), size.to_le_bytes()];
        self.send(BROADCAST, instruction::SYNC_WRITE, &[prefix.as_flattened(), scratch])
    }

    /// Reads `size` bytes from `address` on of all servos in `ids`, and gives each its place, its answer and its bytes.
    /// Returns whether all answered.
    pub(super) fn sync_read(
        &mut self,
        address: u16,
        size: u16,
        ids: &[u8],
        mut take: impl FnMut(usize, Answer, &[u8]),
    ) -> Result<bool, Fault> {
        let prefix = [address.to_le_bytes(), size.to_le_bytes()];
        self.send(BROADCAST, instruction::SYNC_READ, &[prefix.as_flattened(), ids])?;
        // They answer in the order in which they are asked, so that a gap ends with the next.
        let mut next = 0;
        let mut all = true;
        while next < ids.len() {
            let bytes = (ids.len() - next) * (usize::from(size) + 11);
            let answered = self.status(bytes, |id, error, data| {
                let place = next + ids[next..].iter().position(|asked| *asked == id)?;
                (data.len() == usize::from(size)).then(|| {
                    take(place, Answer { alert: error & status_error::ALERT != 0 }, data);
                    place
                })
            });
            match answered {
                Ok(place) => {
                    all &= place == next;
                    next = place + 1;
                }
                Err(Fault::Stale(_)) => return Ok(false),
                Err(fault) => return Err(fault),
            }
        }
        Ok(all)
    }

    /// Lets the bus rest.
    pub(super) fn wait(&mut self, seconds: f64) {
        self.line.wait(seconds);
    }
}
