//! Instructions to servos, and their answers.

use protocol::Port;
use protocol::feetech::{BROADCAST, Decoder, encode, instruction};
use robot::Fault;

/// Longest wait for an answer \[s\], beyond the time of its bytes.
const PATIENCE: f64 = 0.02;
/// Tries of an instruction to one servo that may be repeated.
const TRIES: usize = 3;
/// Bytes of an answer around its data.
const FRAME: usize = 6;

/// The driver's side of a bus. Once its buffers have their size, it allocates nothing.
pub(super) struct Bus {
    port: Box<dyn Port>,
    decoder: Decoder,
    sent: Vec<u8>,
    received: [u8; 256],
    /// Seconds a byte takes.
    byte: f64,
}

fn broken(error: &std::io::Error) -> Fault {
    Fault::Unreachable(format!("the connection is lost: {error}"))
}

impl Bus {
    pub(super) fn new(port: Box<dyn Port>, baud: u32) -> Bus {
        Bus {
            port,
            decoder: Decoder::default(),
            sent: Vec::with_capacity(512),
            received: [0; 256],
            byte: 10.0 / f64::from(baud),
        }
    }

    /// Sends an instruction. What an earlier one left behind is dropped.
    fn send(&mut self, id: u8, code: u8, parameters: &[&[u8]]) -> Result<(), Fault> {
        self.sent.clear();
        encode(&mut self.sent, id, code, parameters);
        self.decoder.clear();
        self.port.discard().and_then(|()| self.port.send(&self.sent)).map_err(|error| broken(&error))
    }

    /// Waits for an answer that `take` accepts: it gets the id, the error byte and the data of each.
    fn answer<R>(
        &mut self,
        bytes: usize,
        mut take: impl FnMut(u8, u8, &[u8]) -> Option<R>,
    ) -> Result<R, Fault> {
        let begun = self.port.now();
        let end = begun + PATIENCE + (self.sent.len() + bytes) as f64 * self.byte;
        // A converter that does not switch its receiver off returns what was sent.
        let echo = self.sent.get(2..5).map(|sent| [sent[0], sent[2]]);
        loop {
            while let Some(packet) = self.decoder.next_packet() {
                let echoed = echo == Some([packet.id, packet.code])
                    && packet.parameters.len() + FRAME == self.sent.len();
                if !echoed && let Some(taken) = take(packet.id, packet.code, packet.parameters) {
                    return Ok(taken);
                }
            }
            let now = self.port.now();
            if now >= end {
                return Err(Fault::Stale(((now - begun) * 1e3).ceil() as u64));
            }
            let count = self.port.receive(&mut self.received, end - now).map_err(|error| broken(&error))?;
            self.decoder.push(&self.received[..count]);
        }
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
