//! Requests to servos, and their answers.

use super::line::Line;
use protocol::Port;
use protocol::servo::{Answer, Cell, Family, Layout, Packets, Request};
use robot::Fault;
use std::ops::ControlFlow;

/// Tries of an instruction to one servo that may be repeated.
const TRIES: usize = 3;
/// Most bytes of one servo that are read at once.
const MOST: usize = 32;

/// How the servos on a bus are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// One request after the other.
    Each,
    /// One request, and one answer from each servo.
    Sync,
    /// One request, and one answer from all servos together.
    Fast,
}

/// The driver's side of a bus. Once it has sent its longest instruction, it allocates nothing.
pub(super) struct Bus {
    line: Line,
    packets: Box<dyn Packets>,
    layout: &'static Layout,
    /// Data of a request to several servos.
    scratch: Vec<u8>,
}

impl Bus {
    pub(super) fn new(port: Box<dyn Port>, baud: u32, family: &Family) -> Bus {
        let packets = (family.packets)();
        Bus { line: Line::new(port, baud), packets, layout: family.layout, scratch: Vec::new() }
    }

    /// Sends a request, and drops the remains of earlier answers.
    fn send(&mut self, id: u8, request: Request<'_>) -> Result<(), Fault> {
        let packets = &mut self.packets;
        packets.clear();
        self.line
            .send(|out| packets.encode(out, id, request).map_err(|error| Fault::Refused(error.to_string())))
    }

    /// Sends a request to one servo, writes its answer to `out`, and returns its error byte.
    fn ask_once(&mut self, id: u8, request: Request<'_>, out: &mut [u8]) -> Result<u8, Fault> {
        self.send(id, request)?;
        let Bus { line, packets, .. } = self;
        let bytes = out.len() + packets.frame();
        line.answers(bytes, |sent, came| {
            let mut error = None;
            packets.answers(sent, came, &mut |answer: Answer<'_>| {
                // An answer without data is a refusal; one of the wrong length answers another request.
                let whole = answer.data.len() == out.len();
                if answer.id != id || !whole && (answer.error == 0 || !answer.data.is_empty()) {
                    return false;
                }
                if whole {
                    out.copy_from_slice(answer.data);
                }
                error = Some((answer.error, whole));
                true
            });
            error.map_or(ControlFlow::Continue(None), ControlFlow::Break)
        })
        .and_then(|(error, whole)| match self.packets.verdict(error) {
            // The servo reports a damaged instruction: the request is repeated.
            verdict if verdict.damaged => Err(Fault::Stale(0)),
            verdict if verdict.refusal.is_some() || !whole => {
                let why = verdict.refusal.or(verdict.trouble);
                let why =
                    why.unwrap_or_else(|| format!("it answers with the unknown error {error:#04x}").into());
                Err(Fault::Refused(format!("servo {id}: {why}")))
            }
            _ => Ok(error),
        })
    }

    /// Sends a request to one servo until it answers, at most [`TRIES`] times.
    fn ask(&mut self, id: u8, request: Request<'_>, out: &mut [u8]) -> Result<u8, Fault> {
        let mut last = Fault::Stale(0);
        for _ in 0..TRIES {
            match self.ask_once(id, request, out) {
                Err(fault @ Fault::Stale(_)) => last = fault,
                other => return other,
            }
        }
        Err(last)
    }

    /// Reads a register of one servo, and its error byte.
    pub(super) fn look(&mut self, id: u8, cell: Cell) -> Result<(i64, u8), Fault> {
        let mut data = [0; 4];
        let data = &mut data[..usize::from(cell.size)];
        let error = self.ask(id, Request::Read(cell.address, cell.size), data)?;
        Ok((cell.decode(data), error))
    }

    /// Reads a register of one servo.
    pub(super) fn read(&mut self, id: u8, cell: Cell) -> Result<i64, Fault> {
        Ok(self.look(id, cell)?.0)
    }

    /// Reads a register whose value must be certain: answers carry no sequence number, so a late one can be mistaken for another.
    /// Two readings in a row must agree.
    pub(super) fn read_twice(&mut self, id: u8, cell: Cell) -> Result<i64, Fault> {
        let mut before = self.read(id, cell)?;
        for _ in 0..TRIES {
            let again = self.read(id, cell)?;
            if again == before {
                return Ok(again);
            }
            before = again;
        }
        Ok(before)
    }

    /// Writes a register of one servo.
    pub(super) fn write(&mut self, id: u8, cell: Cell, value: i64) -> Result<(), Fault> {
        let bytes = cell.encode(value);
        let request = Request::Write(cell.address, &bytes[..usize::from(cell.size)]);
        self.ask(id, request, &mut []).map(drop)
    }

    /// Writes a register, and verifies it by reading.
    pub(super) fn write_surely(&mut self, id: u8, cell: Cell, value: i64) -> Result<(), Fault> {
        for _ in 0..TRIES {
            self.write(id, cell, value)?;
            if self.read(id, cell)? == value {
                return Ok(());
            }
        }
        let address = cell.address;
        Err(Fault::Refused(format!("servo {id}: its register {address} does not accept the value {value}")))
    }

    /// Restarts a servo; it is silent for a while.
    pub(super) fn reboot(&mut self, id: u8) -> Result<(), Fault> {
        self.ask(id, Request::Reboot, &mut []).map(drop)
    }

    /// The hardware errors of a servo that answered with this error byte, in words.
    pub(super) fn trouble(&mut self, id: u8, error: u8) -> Result<Option<String>, Fault> {
        if error == 0 {
            return Ok(None);
        }
        let Some(trouble) = self.packets.verdict(error).trouble else { return Ok(None) };
        Ok(Some(match self.layout.hardware_error {
            Some((cell, describe)) => describe(self.read(id, cell)? as u8),
            None => trouble.into_owned(),
        }))
    }

    /// Writes the same register of several servos at once; none of them answers.
    pub(super) fn write_all(
        &mut self,
        cell: Cell,
        values: impl Iterator<Item = (u8, i64)>,
    ) -> Result<(), Fault> {
        let mut data = std::mem::take(&mut self.scratch);
        data.clear();
        for (id, value) in values {
            data.push(id);
            data.extend_from_slice(&cell.encode(value)[..usize::from(cell.size)]);
        }
        let sent = if data.is_empty() {
            Ok(())
        } else {
            self.send(0, Request::SyncWrite(cell.address, cell.size, &data))
        };
        self.scratch = data;
        sent
    }

    /// Reads `size` bytes at the address `from` of all servos in `ids`, and calls `take` with the index of each servo in `ids`, its
    /// error byte and its bytes. Returns whether all answered.
    pub(super) fn read_all(
        &mut self,
        reading: Reading,
        (from, size): (u16, u16),
        ids: &[u8],
        mut take: impl FnMut(usize, u8, &[u8]),
    ) -> Result<bool, Fault> {
        let request = match reading {
            Reading::Each => return self.read_each((from, size), ids, take),
            Reading::Sync => Request::SyncRead(from, size, ids),
            Reading::Fast => Request::FastSyncRead(from, size, ids),
        };
        self.send(0, request)?;
        let Bus { line, packets, .. } = self;
        let each = usize::from(size) + packets.frame();
        // Servos answer in the order of `ids`, so an answer means that those before it are missing.
        let (mut next, mut all) = (0, true);
        let answered = line.answers(ids.len() * each, |sent, came| {
            let before = next;
            packets.answers(sent, came, &mut |answer| {
                let place = ids[next..].iter().position(|asked| *asked == answer.id);
                if let Some(place) = place.filter(|_| answer.data.len() == usize::from(size)) {
                    take(next + place, answer.error, answer.data);
                    all &= place == 0;
                    next += place + 1;
                }
                next == ids.len()
            });
            match ids.len() - next {
                0 => ControlFlow::Break(()),
                left => ControlFlow::Continue((next > before).then_some(left * each)),
            }
        });
        match answered {
            Ok(()) => Ok(all),
            Err(Fault::Stale(_)) => Ok(false),
            Err(fault) => Err(fault),
        }
    }

    fn read_each(
        &mut self,
        (from, size): (u16, u16),
        ids: &[u8],
        mut take: impl FnMut(usize, u8, &[u8]),
    ) -> Result<bool, Fault> {
        let mut data = [0; MOST];
        let data = &mut data[..usize::from(size).min(MOST)];
        for (place, id) in ids.iter().enumerate() {
            match self.ask_once(*id, Request::Read(from, size), data) {
                Ok(error) => take(place, error, data),
                // Waiting for the remaining servos would delay the next reading.
                Err(Fault::Stale(_)) => return Ok(false),
                Err(fault) => return Err(fault),
            }
        }
        Ok(true)
    }

    /// Waits without using the bus.
    pub(super) fn wait(&mut self, seconds: f64) {
        self.line.wait(seconds);
    }
}
