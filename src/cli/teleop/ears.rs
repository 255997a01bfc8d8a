//! Reads the devices and the keyboard in the time between two ticks.

use crate::failure::Failure;
use ::teleop::devices::{Opened, Terminal, wait};
use ::teleop::{Event, Held, LeaderArm, Sample, TeleopError};
use robot::Clock;
use std::os::fd::{AsFd, BorrowedFd};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Devices, and the keys, buttons and axes that are held on them.
pub struct Ears {
    /// The device that drives, unless it is the keyboard.
    pub device: Option<Opened>,
    /// A leader arm.
    pub leader: Option<LeaderArm>,
    /// The keyboard.
    pub terminal: Option<Terminal>,
    held: Held,
    began: Instant,
    came: Vec<f64>,
    failed: Option<Failure>,
    gone: bool,
}

/// Ears that the loop and the clock of a robot share.
#[derive(Clone)]
pub struct Listening(Arc<Mutex<Ears>>);

impl Listening {
    /// Ears without devices.
    pub fn new() -> Self {
        Listening(Arc::new(Mutex::new(Ears {
            device: None,
            leader: None,
            terminal: None,
            held: Held::default(),
            began: Instant::now(),
            came: Vec::new(),
            failed: None,
            gone: false,
        })))
    }

    /// The ears, for as long as nobody else needs them.
    pub fn ears(&self) -> MutexGuard<'_, Ears> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A clock whose waiting listens: a robot's control period passes while the person is heard.
pub struct ListeningClock(pub Listening);

impl Clock for ListeningClock {
    fn now(&mut self) -> f64 {
        self.0.ears().now()
    }

    fn wait(&mut self, seconds: f64) {
        let mut ears = self.0.ears();
        let due = ears.now() + seconds;
        ears.listen(due);
    }
}

impl Ears {
    /// Seconds since it was made.
    pub fn now(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Name of the device that drives.
    pub fn name(&self) -> &str {
        match (&self.device, &self.leader) {
            (Some(device), _) => device.name(),
            (None, Some(_)) => "the leader arm",
            (None, None) => "the keyboard",
        }
    }

    /// Restores the terminal, and closes a leader arm.
    ///
    /// # Errors
    /// The leader arm cannot be closed; its servos may still have torque.
    pub fn close(&mut self) -> Result<(), Failure> {
        self.terminal = None;
        self.leader.take().map_or(Ok(()), |leader| Ok(leader.close()?))
    }

    /// The input that is held now.
    pub fn sample(&mut self) -> Sample {
        let now = self.now();
        self.held.sample(now)
    }

    /// Times [s] of the events since the last call.
    pub fn came(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.came)
    }

    /// Whether there is still input.
    ///
    /// # Errors
    /// A device that failed or was disconnected.
    pub fn outcome(&mut self) -> Result<bool, Failure> {
        self.failed.take().map_or(Ok(!self.gone), Err)
    }

    /// Reads the devices until `due` [s]; after one of them has failed, only waits.
    pub fn listen(&mut self, due: f64) {
        loop {
            if self.failed.is_some() || self.gone {
                // A time that has passed is not waited for.
                std::thread::sleep(Duration::try_from_secs_f64(due - self.now()).unwrap_or_default());
                return;
            }
            let mut events = Vec::new();
            let outcome = self.hear(due, &mut events);
            let now = self.now();
            for event in events {
                self.held.apply(event, now);
                // A leader arm sends its position all the time: latency is not measured for it.
                self.came.extend((!matches!(event, Event::Lead(..))).then_some(now));
            }
            match outcome {
                Ok(there) => self.gone = !there,
                Err(failure) => self.failed = Some(failure),
            }
            if now >= due {
                return;
            }
        }
    }

    /// Waits for the devices until `due` [s], and reads their events; false after the last device has ended.
    fn hear(&mut self, due: f64, events: &mut Vec<Event>) -> Result<bool, Failure> {
        let files: Vec<BorrowedFd<'_>> =
            self.terminal.iter().map(AsFd::as_fd).chain(self.device.iter().map(AsFd::as_fd)).collect();
        let until = self.leader.as_ref().map_or(due, |leader| leader.due().min(due));
        let ready = wait(&files, until - self.now()).map_err(Failure::new)?;
        let (now, mut ready) = (self.now(), ready.into_iter());
        if let Some(terminal) = &mut self.terminal {
            let there = terminal.read(ready.next().unwrap_or(false), now, events);
            self.held.tells_releases(terminal.tells_releases());
            if !there && self.device.is_none() {
                return Ok(false);
            }
            if !there {
                self.terminal = None;
            }
        }
        if ready.next().unwrap_or(false)
            && let Some(device) = &mut self.device
        {
            device.read(events).map_err(|error: TeleopError| Failure::from(error))?;
        }
        if let Some(leader) = self.leader.as_mut().filter(|leader| now >= leader.due()) {
            leader.tend(now, events)?;
        }
        Ok(true)
    }
}
