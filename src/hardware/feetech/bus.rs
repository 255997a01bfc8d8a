//! Instructions to servos, and their answers.

use crate::serial_line::SerialLine;
use protocol::Port;
use protocol::feetech::{BROADCAST, Decoder, encode, instruction};
use robot::Fault;

/// Tries of an instruction to one servo that may be repeated.
const TRIES: usize = 3;
/// Bytes of an answer around its data.
const FRAME: usize = 6;

/// The driver's side of a bus.
pub(super) struct Bus {
    line: SerialLine,
    decoder: Decoder,
}

impl Bus {
    pub(super) fn new(port: Box<dyn Port>, baud: u32) -> Bus {
        Bus { line: SerialLine::new(port, baud), decoder: Decoder::default() }
    }

    /// Sends an instruction. What an earlier one left behind is dropped.
    fn send(&mut self, id: u8, code: u8, parameters: &[&[u8]]) -> Result<(), Fault> {
        self.decoder.clear();
        self.line.send(|out| encode(out, id, code, parameters))
    }

    /// Waits for an answer that `take` accepts: it gets the id, the error byte and the data of each.
    fn answer<R>(
        &mut self,
        bytes: usize,
        mut take: impl FnMut(u8, u8, &[u8]) -> Option<R>,
    ) -> Result<R, Fault> {
        let Bus { line, decoder } = self;
        line.answer(bytes, |sent, came| {
            decoder.push(came);
            while let Some(packet) = decoder.next_packet() {
                // A converter that does not switch its receiver off returns what was sent.
                let echoed = sent.get(2) == Some(&packet.id)
                    && sent.get(4) == Some(&packet.code)
                    && packet.parameters.len() + FRAME == sent.len();
                let taken = if echoed { None } else { take(packet.id, packet.code, packet.parameters) };
                if taken.is_some() {
                    return taken;
                }
            }
            None
        })
    }

    /// Asks one servo until it answers, a few times; returns its error byte.
    fn ask(&mut self, id: u8, code: u8, parameters: &[&[u8]], out: &mut [u8]) -> Result<u8, Fault> {
        let mut last = Fault::Stale(0);
        for _ in 0..TRIES {
            self.send(id, code, parameters)?;
            let expected = out.len();
            let answered = self.answer(expected + FRAME, |from, error, data| {
                (from == id && data.len() == expected).then(|| {
                    out.copy_from_slice(data);
                    error
                })
            });
            match answered {
                Err(fault @ Fault::Stale(_)) => last = fault,
                other => return other,
            }
        }
        Err(last)
    }

    /// Whether a servo is there; its error byte.
    pub(super) fn ping(&mut self, id: u8) -> Result<u8, Fault> {
        self.ask(id, instruction::PING, &[], &mut [])
    }

    /// A register of one or two bytes.
    pub(super) fn read<const N: usize>(&mut self, id: u8, address: u8) -> Result<[u8; N], Fault> {
        let mut data = [0; N];
        self.ask(id, instruction::READ, &[&[address, N as u8]], &mut data)?;
        Ok(data)
    }

    /// Writes registers from an address on.
    pub(super) fn write(&mut self, id: u8, address: u8, data: &[u8]) -> Result<(), Fault> {
        self.ask(id, instruction::WRITE, &[&[address], data], &mut []).map(drop)
    }

    /// Writes `N` bytes from an address on of several servos at once; none of them answers.
    pub(super) fn sync_write<const N: usize>(
        &mut self,
        address: u8,
        values: impl Iterator<Item = (u8, [u8; N])>,
        scratch: &mut Vec<u8>,
    ) -> Result<(), Fault> {
        scratch.clear();
        for (id, value) in values {
            scratch.push(id);
            scratch.extend_from_slice(&value);
        }
        self.send(BROADCAST, instruction::SYNC_WRITE, &[&[address, N as u8], scratch])
    }

    /// Reads `N` bytes from an address on of all servos in `ids`, and gives each its place, its error byte and its bytes.
    /// Returns whether all answered.
    pub(super) fn sync_read<const N: usize>(
        &mut self,
        address: u8,
        ids: &[u8],
        mut take: impl FnMut(usize, u8, &[u8; N]),
    ) -> Result<bool, Fault> {
        self.send(BROADCAST, instruction::SYNC_READ, &[&[address, N as u8], ids])?;
        let (mut next, mut all) = (0, true);
        while next < ids.len() {
            let bytes = (ids.len() - next) * (N + FRAME);
            let answered = self.answer(bytes, |id, error, data| {
                let place = next + ids[next..].iter().position(|asked| *asked == id)?;
                let data = <&[u8; N]>::try_from(data).ok()?;
                take(place, error, data);
                Some(place)
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
}
