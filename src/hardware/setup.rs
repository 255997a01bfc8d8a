//! What drivers run with: what is allowed, and whose time it is.

use crate::port::{Captures, Network, NoCaptures, NoNetwork, Opener, Serial, Sockets, System};
use crate::service::{Services, TendedClock};
use protocol::Port;
use robot::{Clock, WallClock};
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

/// Makes a clock; all of them show the same time.
pub type Clocks = Arc<dyn Fn() -> Box<dyn Clock + Send> + Send + Sync>;

/// What drivers run with.
#[derive(Clone)]
#[non_exhaustive]
pub struct Setup {
    /// Devices may move.
    pub armed: bool,
    /// Devices are read, and told nothing; what they would be told is said instead.
    pub dry_run: bool,
    /// Where the last minutes are kept, one file a device; nowhere when `None`.
    pub records: Option<PathBuf>,
    /// Opens serial ports.
    pub serial: Opener,
    /// Opens connections and sockets.
    pub sockets: Arc<dyn Sockets>,
    /// Opens cameras.
    pub captures: Arc<dyn Captures>,
    /// Time.
    pub clocks: Clocks,
    /// What a driver has to say to a person.
    pub say: Arc<dyn Fn(&str) + Send + Sync>,
    /// Whether whoever drives has asked for the end: the motion of a reset then stops, and the device is made safe.
    pub halted: Arc<dyn Fn() -> bool + Send + Sync>,
    /// Watchdogs and control loops that a [`TendedClock`](crate::TendedClock) runs; `None` gives each a thread.
    pub services: Option<Services>,
    /// Whether other programs are kept from the same device.
    pub locks: bool,
}

impl Default for Setup {
    /// Real ports in real time. Nothing moves.
    fn default() -> Self {
        let start = WallClock::default();
        Setup {
            armed: false,
            dry_run: false,
            records: None,
            serial: Arc::new(open_serial),
            sockets: Arc::new(Network),
            captures: Arc::new(System),
            clocks: Arc::new(move || Box::new(start)),
            say: Arc::new(|line| eprintln!("{line}")),
            halted: Arc::new(|| false),
            services: None,
            locks: true,
        }
    }
}

fn open_serial(path: &str, baud: u32) -> io::Result<Box<dyn Port>> {
    Ok(Box::new(Serial::open(path, baud)?))
}

impl Setup {
    /// A clock to wait with; where no threads run the services, its waiting does.
    pub(crate) fn clock(&self) -> Box<dyn Clock + Send> {
        let clock = (self.clocks)();
        match &self.services {
            Some(services) => Box::new(TendedClock::new(clock, services.clone())),
            None => clock,
        }
    }

    /// Devices in the time of `clock`, without threads, without locks, without the network and without cameras, so that no
    /// driver reaches a real device by accident: for simulated devices. What moves the time must be a [`TendedClock`](crate::TendedClock) over
    /// the same [`Services`].
    #[must_use]
    pub fn in_virtual_time(mut self, clocks: Clocks, services: Services, serial: Opener) -> Self {
        self.clocks = clocks;
        self.services = Some(services);
        self.serial = serial;
        self.sockets = Arc::new(NoNetwork);
        self.captures = Arc::new(NoCaptures);
        self.locks = false;
        self
    }

    /// How connections and sockets are opened.
    #[must_use]
    pub fn with_sockets(mut self, sockets: Arc<dyn Sockets>) -> Self {
        self.sockets = sockets;
        self
    }

    /// How cameras are opened.
    #[must_use]
    pub fn with_captures(mut self, captures: Arc<dyn Captures>) -> Self {
        self.captures = captures;
        self
    }

    /// Whether devices may move.
    #[must_use]
    pub fn with_armed(mut self, armed: bool) -> Self {
        self.armed = armed;
        self
    }

    /// Whether devices are told nothing.
    #[must_use]
    pub fn with_dry_run(mut self, dry_run: bool) -> Self {
        self.dry_run = dry_run;
        self
    }

    /// What says that whoever drives has asked for the end.
    #[must_use]
    pub fn with_halted(mut self, halted: Arc<dyn Fn() -> bool + Send + Sync>) -> Self {
        self.halted = halted;
        self
    }

    /// Where the last minutes of each device are kept.
    #[must_use]
    pub fn with_records(mut self, folder: Option<PathBuf>) -> Self {
        self.records = folder;
        self
    }
}
