//! Work beside the caller's: watchdogs and control loops, in threads or on a clock.

use protocol::Port;
use robot::Clock;
use std::io;
use std::sync::{Arc, Mutex, PoisonError, TryLockError, Weak};

/// How often a watchdog looks, in a thread or on a tended clock \[s\].
pub(crate) const LOOK: f64 = 0.005;

/// Work that goes on beside the caller's.
pub(crate) trait Service: Send {
    /// Does what is due at `now` \[s\].
    fn tend(&mut self, now: f64);
}

/// Watchdogs and control loops that a clock runs.
#[derive(Clone, Default)]
pub struct Services(Arc<Mutex<Vec<Listed>>>);

/// A service that ends with its device, and how often it must be tended \[s\].
struct Listed {
    service: Weak<Mutex<dyn Service>>,
    period: f64,
}

impl Services {
    pub(crate) fn add(&self, service: Weak<Mutex<dyn Service>>, period: f64) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(Listed { service, period });
    }

    /// Runs all services at `now`, except those in use: one of them is waiting. Dropped services are removed. Returns the
    /// shortest of their periods \[s\].
    fn tend(&self, now: f64) -> f64 {
        let mut services = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        services.retain(|listed| listed.service.strong_count() > 0);
        let period = services.iter().map(|listed| listed.period).fold(LOOK, f64::min);
        let alive: Vec<_> = services.iter().filter_map(|listed| listed.service.upgrade()).collect();
        drop(services);
        for service in alive {
            match service.try_lock() {
                Ok(mut service) => service.tend(now),
                Err(TryLockError::Poisoned(service)) => service.into_inner().tend(now),
                Err(TryLockError::WouldBlock) => {}
            }
        }
        period
    }

    /// Waits for `seconds` with the clock of `device`, and runs the services meanwhile.
    fn wait<T>(&self, device: &mut T, seconds: f64, now: impl Fn(&mut T) -> f64, wait: impl Fn(&mut T, f64)) {
        let end = now(device) + seconds;
        loop {
            let period = self.tend(now(device));
            // Tending takes time too: it may talk to a device.
            let left = end - now(device);
            if left <= 0.0 {
                return;
            }
            wait(device, left.min(period));
        }
    }
}

/// A clock that tends [`Services`] while it is waited for, as their threads would.
pub struct TendedClock<C> {
    clock: C,
    services: Services,
}

impl<C: Clock> TendedClock<C> {
    /// Runs `services` on `clock`.
    pub fn new(clock: C, services: Services) -> Self {
        TendedClock { clock, services }
    }
}

impl<C: Clock> Clock for TendedClock<C> {
    fn now(&mut self) -> f64 {
        self.clock.now()
    }

    fn wait(&mut self, seconds: f64) {
        self.services.wait(&mut self.clock, seconds, C::now, C::wait);
    }
}

/// A port of one device in virtual time, whose waiting tends the [`Services`] of the others, as their threads would.
pub struct TendedPort<P> {
    port: P,
    services: Services,
}

impl<P: Port> TendedPort<P> {
    /// Runs `services` while `port` is waited for.
    pub fn new(port: P, services: Services) -> Self {
        TendedPort { port, services }
    }
}

impl<P: Port> Port for TendedPort<P> {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.port.send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        let end = self.port.now() + timeout;
        let mut left = timeout;
        loop {
            // Without a wait no service runs.
            let period = if left > 0.0 { self.services.tend(self.port.now()) } else { 0.0 };
            let count = self.port.receive(buffer, left.min(period))?;
            left = end - self.port.now();
            if count > 0 || left <= 0.0 {
                return Ok(count);
            }
        }
    }

    fn discard(&mut self) -> io::Result<()> {
        self.port.discard()
    }

    fn now(&self) -> f64 {
        self.port.now()
    }

    fn wait(&mut self, seconds: f64) {
        self.services.wait(&mut self.port, seconds, |port| port.now(), P::wait);
    }
}
