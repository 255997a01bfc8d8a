//! A driver made safe.

use crate::driver::Driver;
use crate::recorder::{Event, Recorder};
use crate::safety::limits::Limiter;
use crate::safety::lock::Lock;
use crate::safety::motion::Motion;
use crate::safety::watchdog::{Silence, Watchdog};
use crate::service::{LOOK, Service};
use crate::setup::Setup;
use robot::{Clock, Device, Fault};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::JoinHandle;
use std::time::Duration;

/// Time between two commands of a reset \[s\].
const RESET_PERIOD: f64 = 0.02;
/// Longest that a device may take to become safe \[s\].
const SAFE_AT_LAST: f64 = 3.0;

/// What a guarded device may do.
#[derive(Clone, Debug, PartialEq)]
enum Phase {
    /// No connection.
    Closed,
    /// Connected; it has not been armed.
    Idle,
    /// It follows commands.
    Armed,
    /// On the way to its safe state, for this reason.
    Stopping(Fault),
    /// In its safe state, for this reason.
    Safe(Fault),
}

/// What caller and watchdog share.
struct Core {
    name: String,
    driver: Box<dyn Driver>,
    setup: Setup,
    clock: Box<dyn Clock + Send>,
    phase: Phase,
    /// Why the device could not be made safe when that was last tried.
    obstacle: Option<Fault>,
    limiter: Limiter,
    watchdog: Watchdog,
    recorder: Option<Recorder>,
    /// The newest reading, which the watchdog's own heartbeats refresh.
    values: Vec<f64>,
    /// When the device was connected \[s\].
    connected: f64,
    commands: Vec<f64>,
    present: Vec<f64>,
}

/// A device of a robot: a driver, with what makes it safe to use around it.
///
/// Readings have the time since the connection began. A fault of the link or the hardware, and silence, bring the device into
/// its safe state; [`Device::reset`] reconnects where needed and arms it again.
pub struct Guarded {
    core: Arc<Mutex<Core>>,
    watching: Option<(Arc<AtomicBool>, JoinHandle<()>)>,
    lock: Option<Lock>,
}

impl Guarded {
    /// A device of this name with these numbers of sensors and actuators. Nothing is opened yet.
    pub fn new(
        name: &str,
        driver: Box<dyn Driver>,
        sensors: usize,
        actuators: usize,
        setup: &Setup,
    ) -> Guarded {
        let limiter = Limiter::new(driver.limits());
        let mut clock = setup.clock();
        let watchdog = Watchdog::new(driver.timeouts(), clock.now());
        let core = Core {
            name: name.to_owned(),
            driver,
            clock,
            phase: Phase::Closed,
            obstacle: None,
            limiter,
            watchdog,
            recorder: None,
            values: vec![0.0; sensors],
            connected: 0.0,
            commands: vec![0.0; actuators],
            present: vec![0.0; actuators],
            setup: setup.clone(),
        };
        Guarded { core: Arc::new(Mutex::new(core)), watching: None, lock: None }
    }

    fn core(&self) -> MutexGuard<'_, Core> {
        self.core.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the watchdog's thread.
    fn unwatch(&mut self) {
        if let Some((stop, thread)) = self.watching.take() {
            stop.store(true, Ordering::Relaxed);
            // A watchdog that panicked has said so; what is left is to go on.
            thread.join().unwrap_or_default();
        }
    }

    /// Lets the watchdog look from now on; the one of an earlier connection ends.
    fn watch(&mut self) {
        self.unwatch();
        let services = self.core().setup.services.clone();
        if let Some(services) = services {
            let service: Weak<Mutex<Core>> = Arc::downgrade(&self.core);
            services.add(service, self.core().period());
            return;
        }
        let stop = Arc::new(AtomicBool::new(false));
        let (core, asked) = (self.core.clone(), stop.clone());
        let period = Duration::from_secs_f64(self.core().period());
        let look = move || {
            while !asked.load(Ordering::Relaxed) {
                let mut core = core.lock().unwrap_or_else(PoisonError::into_inner);
                let now = core.clock.now();
                core.tend(now);
                drop(core);
                std::thread::sleep(period);
            }
        };
        self.watching = Some((stop, std::thread::spawn(look)));
    }
}

impl Device for Guarded {
    fn connect(&mut self) -> Result<(), Fault> {
        let (resource, locks) = {
            let core = self.core();
            (core.driver.resource(), core.setup.locks)
        };
        if locks && self.lock.is_none() {
            self.lock = Some(Lock::take(&resource).map_err(|error| Fault::Unreachable(error.to_string()))?);
        }
        self.core().connect()?;
        self.watch();
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault> {
        self.core().read(values)
    }

    fn apply(&mut self, _time: f64, commands: &[f64]) -> Result<(), Fault> {
        if self.watching.as_ref().is_some_and(|(_, thread)| thread.is_finished()) {
            let fault = Fault::Refused("its watchdog has ended; connect the robot again".to_owned());
            self.core().stop(fault.clone());
            return Err(fault);
        }
        self.core().apply(commands)
    }

    fn reset(&mut self, targets: &[f64]) -> Result<(), Fault> {
        if targets.is_empty() {
            return self.core().reconnect();
        }
        let mut motion = self.core().begin_reset(targets)?;
        let mut clock = self.core().setup.clock();
        self.core().driver.set_resetting(true);
        let mut outcome = Ok(());
        while !motion.done() && outcome.is_ok() {
            // The lock is free while the motion waits, so that the watchdog looks.
            clock.wait(RESET_PERIOD);
            let mut core = self.core();
            outcome = if (core.setup.halted)() { Err(core.halt()) } else { core.go_on(&mut motion) };
            core.tend(clock.now());
        }
        let mut core = self.core();
        core.driver.set_resetting(false);
        core.watchdog.rest();
        outcome
    }

    fn moved(&mut self) -> Result<(), Fault> {
        let mut core = self.core();
        match core.phase {
            Phase::Closed => Err(Fault::NotConnected),
            _ => core.driver.moved(),
        }
    }

    fn close(&mut self) -> Result<(), Fault> {
        self.unwatch();
        let outcome = self.core().close();
        self.lock = None;
        outcome
    }
}

impl Drop for Guarded {
    fn drop(&mut self) {
        // Nobody is left to hear of a failure.
        self.close().unwrap_or_default();
    }
}

impl Core {
    fn connect(&mut self) -> Result<(), Fault> {
        if let (Some(folder), None) = (self.setup.records.as_deref(), &self.recorder) {
            let recorder = Recorder::create(folder, &self.name, self.values.len(), self.commands.len());
            let refused = |error| Fault::Refused(format!("its record cannot begin: {error}"));
            self.recorder = Some(recorder.map_err(refused)?);
        }
        self.driver.connect()?;
        // What a device may do can depend on which it is.
        self.limiter.set_limits(self.driver.limits());
        let now = self.clock.now();
        self.connected = now;
        self.watchdog = Watchdog::new(self.driver.timeouts(), now);
        self.driver.read(&mut self.values).map_err(|fault| match fault {
            Fault::Stale(_) => Fault::Unreachable("it does not answer when it is read".to_owned()),
            fault => fault,
        })?;
        self.phase = Phase::Idle;
        Ok(())
    }

    /// How often the device must be looked after \[s\].
    fn period(&self) -> f64 {
        self.driver.period().map_or(LOOK, |period| period.min(LOOK))
    }

    /// Lets the driver do what is due beside its commands.
    fn work(&mut self) {
        if self.phase == Phase::Closed || self.driver.period().is_none() {
            return;
        }
        // A fault stops the device by itself.
        if let Err(fault) = self.driver.work() {
            self.stop(fault);
        }
        if let Some(note) = self.driver.take_note() {
            self.record(Event::Note(&note));
        }
    }

    fn record(&mut self, event: Event<'_>) {
        let now = self.clock.now() - self.connected;
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.record(now, event)
        {
            (self.setup.say)(&format!("{}: its record ends here: {error}", self.name));
            self.recorder = None;
        }
    }

    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault> {
        if values.len() != self.values.len() {
            return Err(Fault::Length { given: self.values.len(), expected: values.len() });
        }
        self.refresh()?;
        values.copy_from_slice(&self.values);
        Ok(self.watchdog.last_reading() - self.connected)
    }

    /// Reads the device.
    fn refresh(&mut self) -> Result<(), Fault> {
        match &self.phase {
            Phase::Closed => return Err(Fault::NotConnected),
            // A device that is safe because of silence can still be read.
            Phase::Idle | Phase::Armed | Phase::Stopping(_) | Phase::Safe(_) => {}
        }
        let mut values = std::mem::take(&mut self.values);
        let outcome = self.driver.read(&mut values);
        self.values = values;
        let now = self.clock.now();
        match outcome {
            Ok(()) => {
                self.watchdog.has_read(now);
                let values = std::mem::take(&mut self.values);
                self.record(Event::Reading(&values));
                self.values = values;
                Ok(())
            }
            // One lost answer is not the end: the watchdog decides for how long none may come.
            Err(fault @ Fault::Stale(_)) if self.watchdog.check(now).is_none() => {
                self.record(Event::Fault(&fault));
                Ok(())
            }
            Err(Fault::Stale(_)) => {
                let fault = Fault::Stale(((now - self.watchdog.last_reading()) * 1e3) as u64);
                self.stop(fault.clone());
                Err(fault)
            }
            Err(fault) => {
                self.stop(fault.clone());
                Err(fault)
            }
        }
    }

    fn apply(&mut self, commands: &[f64]) -> Result<(), Fault> {
        match &self.phase {
            Phase::Armed => {}
            // What only measures needs no arming.
            Phase::Idle if self.commands.is_empty() => return Ok(()),
            Phase::Closed => return Err(Fault::NotConnected),
            Phase::Idle => return Err(self.unarmed()),
            Phase::Stopping(why) | Phase::Safe(why) => return Err(why.clone()),
        }
        let now = self.clock.now();
        if commands.len() != self.commands.len() {
            return Err(Fault::Length { given: commands.len(), expected: self.commands.len() });
        }
        let mut limited = std::mem::take(&mut self.commands);
        limited.copy_from_slice(commands);
        let outcome = self.limiter.limit(now, &mut limited).and_then(|()| self.send(&limited));
        self.commands = limited;
        match outcome {
            Ok(()) => {
                self.watchdog.commanded(now);
                Ok(())
            }
            // A bad value never reached the device, which goes on as it was until the watchdog stops it.
            Err(fault @ (Fault::BadValue(_) | Fault::Length { .. })) => {
                self.record(Event::Fault(&fault));
                Err(fault)
            }
            Err(fault) => {
                self.stop(fault.clone());
                Err(fault)
            }
        }
    }

    /// Sends commands that are within limits, or says them.
    fn send(&mut self, commands: &[f64]) -> Result<(), Fault> {
        self.driver.check(commands)?;
        if self.setup.dry_run {
            (self.setup.say)(&format!("{}: would be sent {commands:.4?}", self.name));
        } else {
            self.driver.command(commands)?;
        }
        self.record(Event::Command(commands));
        Ok(())
    }

    fn unarmed(&self) -> Fault {
        Fault::Refused("nothing moves before it is armed (--arm)".to_owned())
    }

    /// Connects again after a fault; a device without actuators needs no more.
    fn reconnect(&mut self) -> Result<(), Fault> {
        match &self.phase {
            Phase::Safe(_) | Phase::Stopping(_) => {
                self.driver.disconnect();
                self.connect()
            }
            Phase::Closed => Err(Fault::NotConnected),
            Phase::Idle | Phase::Armed => Ok(()),
        }
    }

    /// Arms the device where it stands, and plans the motion to `targets`.
    fn begin_reset(&mut self, targets: &[f64]) -> Result<Motion, Fault> {
        if let Some(bad) = targets.iter().position(|target| !target.is_finite()) {
            return Err(Fault::BadValue(bad));
        }
        if !self.setup.armed && !self.setup.dry_run {
            return Err(self.unarmed());
        }
        self.reconnect()?;
        let mut present = std::mem::take(&mut self.present);
        let arm = self.phase != Phase::Armed && !self.setup.dry_run;
        // From here on parts of the device may have torque: a fault makes it safe.
        self.phase = Phase::Armed;
        let asked = self.driver.present(&mut present);
        let outcome = asked.and_then(|()| if arm { self.driver.arm(&present) } else { Ok(()) });
        self.present = present;
        if let Err(fault) = outcome {
            self.stop(fault.clone());
            return Err(fault);
        }
        let now = self.clock.now();
        self.limiter.begin(now, &self.present);
        self.watchdog.commanded(now);
        self.watchdog.has_read(now);
        Ok(if self.driver.resets() {
            Motion::new(&self.present, targets, now, self.driver.reset_duration())
        } else {
            Motion::none(&self.present)
        })
    }

    /// Makes the device safe because somebody asked for the end.
    fn halt(&mut self) -> Fault {
        let fault =
            Fault::Refused("its motion was ended before it was done; a reset arms it again".to_owned());
        self.stop(fault.clone());
        fault
    }

    /// Commands where a motion is now.
    fn go_on(&mut self, motion: &mut Motion) -> Result<(), Fault> {
        let now = self.clock.now();
        let commands = motion.command(now);
        self.apply(&commands)
    }

    /// Begins to make the device safe.
    fn stop(&mut self, why: Fault) {
        if matches!(self.phase, Phase::Stopping(_) | Phase::Safe(_) | Phase::Closed) {
            return;
        }
        self.record(Event::Fault(&why));
        self.begin_to_stop(why);
    }

    /// The same without a fault that is worth a record.
    fn begin_to_stop(&mut self, why: Fault) {
        let moved = self.phase == Phase::Armed && !self.setup.dry_run;
        self.phase = Phase::Safe(why.clone());
        if moved {
            self.phase = Phase::Stopping(why);
            self.make_safe();
        }
    }

    /// Goes on making the device safe.
    fn make_safe(&mut self) {
        let Phase::Stopping(why) = self.phase.clone() else { return };
        // A device that cannot be reached has a watchdog of its own; it is tried again all the same.
        match self.driver.make_safe() {
            Ok(true) => {
                self.obstacle = None;
                self.phase = Phase::Safe(why);
                self.record(Event::Note("safe"));
            }
            Ok(false) => {}
            Err(fault) => self.obstacle = Some(fault),
        }
    }

    fn close(&mut self) -> Result<(), Fault> {
        match self.phase {
            Phase::Closed => return Ok(()),
            Phase::Idle | Phase::Armed => self.begin_to_stop(Fault::NotConnected),
            Phase::Stopping(_) | Phase::Safe(_) => {}
        }
        let mut clock = self.setup.clock();
        let end = clock.now() + SAFE_AT_LAST;
        while matches!(self.phase, Phase::Stopping(_)) && clock.now() < end {
            clock.wait(self.period());
            self.work();
            self.make_safe();
        }
        let summary = format!("closed; limits changed {} commands", self.limiter.limited());
        self.record(Event::Note(&summary));
        let stopping = matches!(self.phase, Phase::Stopping(_));
        self.driver.disconnect();
        self.phase = Phase::Closed;
        if !stopping {
            return Ok(());
        }
        // Whoever drops a robot does not look at what this returns.
        let why =
            self.obstacle.take().unwrap_or(Fault::Refused("it did not come to rest in time".to_owned()));
        (self.setup.say)(&format!("{}: it may not be in its safe state: {why}", self.name));
        Err(why)
    }
}

impl Service for Core {
    fn tend(&mut self, now: f64) {
        self.work();
        match &self.phase {
            Phase::Closed | Phase::Safe(_) => return,
            Phase::Stopping(_) => return self.make_safe(),
            Phase::Idle | Phase::Armed => {}
        }
        if self.watchdog.heartbeat_due(now) {
            // A fault stops the device by itself.
            self.refresh().unwrap_or_default();
        }
        let now = self.clock.now();
        match self.watchdog.check(now) {
            None => {}
            Some(Silence::Commands) => {
                let limit = self.driver.timeouts().command;
                self.stop(Fault::Refused(format!(
                    "its watchdog stopped it: no command came for {limit} s; a reset arms it again"
                )));
            }
            Some(Silence::Readings) => {
                self.stop(Fault::Stale(((now - self.watchdog.last_reading()) * 1e3) as u64));
            }
        }
    }
}
