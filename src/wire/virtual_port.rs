//! A bench's links as ports, and its time as a clock.

use crate::bench::{Bench, LinkId};
use protocol::Port;
use robot::Clock;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A bench that drivers, clocks and tests share.
pub type Shared = Arc<Mutex<Bench>>;

fn lock(bench: &Shared) -> MutexGuard<'_, Bench> {
    bench.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The driver's end of a link. Waiting lets the bench's time pass, and nothing else does.
#[derive(Clone)]
pub struct VirtualPort {
    bench: Shared,
    link: LinkId,
}

impl VirtualPort {
    /// The driver's end of `link`.
    pub fn new(bench: Shared, link: LinkId) -> VirtualPort {
        VirtualPort { bench, link }
    }

    /// The bench, if the link is connected.
    fn connected(&self) -> io::Result<MutexGuard<'_, Bench>> {
        let bench = lock(&self.bench);
        // Of a cut cable a socket for datagrams learns nothing.
        if bench.connected(self.link) || bench.carries_datagrams(self.link) {
            Ok(bench)
        } else {
            Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the device closed the connection"))
        }
    }
}

impl Port for VirtualPort {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.connected()?.send(self.link, bytes);
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        let mut bench = self.connected()?;
        let end = bench.time() + timeout.max(0.0);
        bench.advance_until(self.link, end);
        drop(bench);
        let bytes = self.connected()?.receive(self.link, buffer.len()).unwrap_or_default();
        let count = bytes.len().min(buffer.len());
        buffer[..count].copy_from_slice(&bytes[..count]);
        Ok(count)
    }

    fn discard(&mut self) -> io::Result<()> {
        self.connected()?.discard(self.link);
        Ok(())
    }

    fn now(&self) -> f64 {
        lock(&self.bench).time()
    }

    fn wait(&mut self, seconds: f64) {
        let mut bench = lock(&self.bench);
        let end = bench.time() + seconds.max(0.0);
        bench.advance(end);
    }
}

/// The bench's time.
#[derive(Clone)]
pub struct VirtualClock(Shared);

impl VirtualClock {
    /// A clock that lets the time of `bench` pass.
    pub fn new(bench: Shared) -> VirtualClock {
        VirtualClock(bench)
    }
}

impl Clock for VirtualClock {
    fn now(&mut self) -> f64 {
        lock(&self.0).time()
    }

    fn wait(&mut self, seconds: f64) {
        let mut bench = lock(&self.0);
        let end = bench.time() + seconds;
        bench.advance(end);
    }
}
