//! Whether commands and readings still come.

/// Times after which a device is made safe \[s\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timeouts {
    /// Without a command, once commands have begun.
    pub command: f64,
    /// Without a reading.
    pub reading: f64,
    /// Time between two readings that the watchdog makes itself where nobody else does, so that a device with a watchdog of
    /// its own hears from its driver.
    pub heartbeat: f64,
}

/// Why a device is to be made safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Silence {
    /// No command came.
    Commands,
    /// No reading came.
    Readings,
}

/// Remembers when it last heard of a device.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watchdog {
    timeouts: Timeouts,
    /// The last command \[s\]; `None` while none is expected.
    command: Option<f64>,
    reading: f64,
}

impl Watchdog {
    /// Begins at `now`, without expecting commands.
    pub(crate) fn new(timeouts: Timeouts, now: f64) -> Watchdog {
        Watchdog { timeouts, command: None, reading: now }
    }

    pub(crate) fn commanded(&mut self, now: f64) {
        self.command = Some(now);
    }

    /// Expects no commands until the next.
    pub(crate) fn rest(&mut self) {
        self.command = None;
    }

    pub(crate) fn has_read(&mut self, now: f64) {
        self.reading = now;
    }

    /// When it last heard of the device \[s\].
    pub(crate) fn last_reading(&self) -> f64 {
        self.reading
    }

    /// Whether the device should be read, so that it hears something.
    pub(crate) fn heartbeat_due(&self, now: f64) -> bool {
        now - self.reading >= self.timeouts.heartbeat
    }

    /// What has been missing for too long.
    pub(crate) fn check(&self, now: f64) -> Option<Silence> {
        if self.command.is_some_and(|last| now - last > self.timeouts.command) {
            Some(Silence::Commands)
        } else {
            (now - self.reading > self.timeouts.reading).then_some(Silence::Readings)
        }
    }
}
