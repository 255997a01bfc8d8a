//! A serial line that one side uses at a time: an instruction goes out, and answers come until it is too late.

use crate::port::broken;
use protocol::Port;
use robot::Fault;
use std::ops::ControlFlow;

/// Longest wait for an answer \[s\], beyond the time of its bytes.
const PATIENCE: f64 = 0.02;
/// Most bytes that are taken from the port at once.
const RECEIVED: usize = 256;
/// Longest instruction that fits without allocation.
const SENT: usize = 1024;

/// The driver's end of a line.
pub(super) struct Line {
    port: Box<dyn Port>,
    sent: Vec<u8>,
    received: [u8; RECEIVED],
    /// Seconds a byte takes.
    byte: f64,
}

impl Line {
    pub(super) fn new(port: Box<dyn Port>, baud: u32) -> Line {
        Line { port, sent: Vec::with_capacity(SENT), received: [0; RECEIVED], byte: 10.0 / f64::from(baud) }
    }

    /// Sends what `encode` appends, and drops what has arrived before.
    pub(super) fn send(
        &mut self,
        encode: impl FnOnce(&mut Vec<u8>) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        self.sent.clear();
        encode(&mut self.sent)?;
        self.port.discard().and_then(|()| self.port.send(&self.sent)).map_err(|error| broken(&error))
    }

    /// Waits for answers of `bytes` bytes. `take` is called with the bytes that were sent and those received since its last call (none
    /// at first) until it breaks. Where it has found some of the answers, it continues with the number of bytes still
    /// missing, and the timeout restarts for these.
    pub(super) fn answers<R>(
        &mut self,
        bytes: usize,
        mut take: impl FnMut(&[u8], &[u8]) -> ControlFlow<R, Option<usize>>,
    ) -> Result<R, Fault> {
        let begun = self.port.now();
        // The instruction is still going out.
        let mut end = begun + PATIENCE + (self.sent.len() + bytes) as f64 * self.byte;
        let mut count = 0;
        loop {
            let taken = take(&self.sent, &self.received[..count]);
            let now = self.port.now();
            match taken {
                ControlFlow::Break(all) => return Ok(all),
                ControlFlow::Continue(Some(bytes)) => end = now + PATIENCE + bytes as f64 * self.byte,
                ControlFlow::Continue(None) => {}
            }
            if now >= end {
                return Err(Fault::Stale(((now - begun) * 1e3).ceil() as u64));
            }
            count = self.port.receive(&mut self.received, end - now).map_err(|error| broken(&error))?;
        }
    }

    /// Lets the line rest.
    pub(super) fn wait(&mut self, seconds: f64) {
        self.port.wait(seconds);
    }
}
