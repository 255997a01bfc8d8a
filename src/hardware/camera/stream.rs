//! The newest frame of a stream.

use crate::port::{Capture, Captures, Format, Frame, Request};
use crate::setup::Setup;
use robot::{Clock, Fault};
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// Longest wait for the first frame \[s\]: cameras take a moment to begin.
const FIRST: f64 = 5.0;
/// How long the thread waits for a frame before it checks whether it should end.
const WAIT: Duration = Duration::from_millis(50);
/// Time between two attempts to open a camera that was lost \[s\].
const AGAIN: f64 = 1.0;

/// Counts of a stream's frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Frames that were received.
    pub frames: u64,
    /// Frames that are missing in the camera's numbering.
    pub dropped: u64,
    /// Frames that the camera's driver reported as damaged; they are not used.
    pub damaged: u64,
    /// Times that the camera was lost and reopened.
    pub reopened: u64,
    /// Longest time between two frames, by the clock of the camera's driver \[s\].
    pub longest: f64,
}

/// A stream that keeps its newest frame.
pub(super) struct Stream {
    format: Format,
    /// Whether its first frames are discarded.
    settles: bool,
    stale: f64,
    newest: Arc<Mutex<Newest>>,
    intake: Intake,
}

/// What takes frames from the camera.
enum Intake {
    /// A thread, in real time.
    Thread { wanted: Arc<AtomicBool>, thread: Option<JoinHandle<()>> },
    /// The caller that asks for the newest frame, in virtual time.
    Asked(Box<Source>),
}

#[derive(Default)]
struct Newest {
    bytes: Vec<u8>,
    /// Time of arrival \[s\], on the clock of the setup.
    time: Option<f64>,
    sequence: Option<u32>,
    /// When the frame was taken, by the camera's driver \[s\].
    taken: Option<f64>,
    /// Why no frames arrive.
    fault: Option<String>,
    counts: Counts,
}

/// A camera that is reopened when it was lost.
struct Source {
    name: String,
    request: Request,
    captures: Arc<dyn Captures>,
    capture: Option<Box<dyn Capture>>,
    format: Format,
    clock: Box<dyn Clock + Send>,
    lost: f64,
}

impl Stream {
    pub(super) fn open(name: &str, request: &Request, stale: f64, setup: &Setup) -> Result<Stream, Fault> {
        let capture = setup.captures.open(name, request)?;
        let (format, settles) = (capture.format(), capture.settles());
        let mut source = Source {
            name: name.to_owned(),
            request: request.clone(),
            captures: setup.captures.clone(),
            capture: Some(capture),
            format,
            clock: setup.clock(),
            lost: 0.0,
        };
        let newest = Arc::new(Mutex::new(Newest::default()));
        let intake = if setup.services.is_some() {
            Intake::Asked(Box::new(source))
        } else {
            let wanted = Arc::new(AtomicBool::new(true));
            let (place, needed) = (newest.clone(), wanted.clone());
            let run = move || {
                while needed.load(Ordering::Relaxed) {
                    source.pull(WAIT, &place);
                }
            };
            let thread = std::thread::Builder::new().name(format!("camera {name}")).spawn(run);
            let thread =
                thread.map_err(|error| Fault::Unreachable(format!("no thread can be started: {error}")))?;
            Intake::Thread { wanted, thread: Some(thread) }
        };
        Ok(Stream { format, settles, stale, newest, intake })
    }

    pub(super) fn format(&self) -> Format {
        self.format
    }

    pub(super) fn counts(&self) -> Counts {
        lock(&self.newest).counts
    }

    /// Waits for `frames` frames and one more, or for one frame of a camera that need not settle.
    pub(super) fn warm_up(&mut self, frames: u32, clock: &mut dyn Clock) -> Result<(), Fault> {
        let frames = if self.settles { frames } else { 0 };
        let end = clock.now() + FIRST + f64::from(frames) / self.format.rate;
        loop {
            self.take_in();
            let newest = lock(&self.newest);
            if newest.counts.frames > u64::from(frames) && newest.time.is_some() {
                return Ok(());
            }
            if let Some(fault) = &newest.fault {
                return Err(Fault::Unreachable(fault.clone()));
            }
            let came = newest.counts.frames;
            drop(newest);
            if clock.now() > end {
                return Err(Fault::Unreachable(format!(
                    "only {came} frames came in {:.0} s; check that no other program uses it and that its cable is fast enough",
                    FIRST + f64::from(frames) / self.format.rate
                )));
            }
            clock.wait(1.0 / self.format.rate);
        }
    }

    /// Decodes the newest frame.
    pub(super) fn newest(
        &mut self,
        clock: &mut dyn Clock,
        decode: impl FnOnce(&[u8]) -> Result<(), String>,
    ) -> Result<(), Fault> {
        self.take_in();
        let newest = lock(&self.newest);
        if let Some(fault) = &newest.fault {
            return Err(Fault::Unreachable(fault.clone()));
        }
        let age = newest.time.map_or(f64::INFINITY, |time| clock.now() - time);
        if age > self.stale {
            return Err(Fault::Stale((1e3 * age.min(1e9)) as u64));
        }
        decode(&newest.bytes)
            .map_err(|why| Fault::Unreachable(format!("its newest frame cannot be decoded: {why}")))
    }

    /// Takes the frames that have arrived, where no thread does.
    fn take_in(&mut self) {
        if let Intake::Asked(source) = &mut self.intake {
            while source.pull(Duration::ZERO, &self.newest) {}
        }
    }
}

impl Drop for Stream {
    fn drop(&mut self) {
        if let Intake::Thread { wanted, thread } = &mut self.intake {
            wanted.store(false, Ordering::Relaxed);
            if let Some(thread) = thread.take() {
                // The thread returns nothing: its results are in `newest`.
                let _ = thread.join();
            }
        }
    }
}

impl Source {
    /// Waits for the next frame and stores it in `place`; returns whether one came.
    fn pull(&mut self, wait: Duration, place: &Mutex<Newest>) -> bool {
        let Some(capture) = &mut self.capture else {
            self.reopen(wait, place);
            return false;
        };
        match capture.next(wait) {
            Ok(Some(frame)) => {
                lock(place).put(&frame, self.clock.now());
                true
            }
            Ok(None) => false,
            Err(error) => {
                lock(place).lose(lost(&error));
                (self.capture, self.lost) = (None, self.clock.now());
                false
            }
        }
    }

    /// Reopens the camera, at most once in [`AGAIN`] seconds.
    fn reopen(&mut self, wait: Duration, place: &Mutex<Newest>) {
        if self.clock.now() - self.lost < AGAIN {
            // A virtual clock advances elsewhere, so this is real time.
            std::thread::sleep(wait);
            return;
        }
        self.lost = self.clock.now();
        match self.captures.open(&self.name, &self.request) {
            Ok(capture) if capture.format() == self.format => {
                self.capture = Some(capture);
                lock(place).reopen();
            }
            Ok(_) => lock(place).lose("it came back with another format; restart the program".to_owned()),
            Err(fault) => lock(place).lose(format!("it was lost: {fault}")),
        }
    }
}

impl Newest {
    fn put(&mut self, frame: &Frame, now: f64) {
        let step = self.sequence.map_or(1, |before| frame.sequence.wrapping_sub(before));
        // A number that goes back means that the camera restarted its count.
        if step > 1 && step < u32::MAX / 2 {
            self.counts.dropped += u64::from(step - 1);
        }
        self.sequence = Some(frame.sequence);
        self.counts.frames += 1;
        let since = self.taken.replace(frame.time).map_or(0.0, |before| frame.time - before);
        self.counts.longest = self.counts.longest.max(since);
        if frame.damaged {
            self.counts.damaged += 1;
            return;
        }
        self.bytes.clear();
        self.bytes.extend_from_slice(frame.bytes);
        self.time = Some(now);
    }

    fn lose(&mut self, why: String) {
        (self.fault, self.time, self.sequence, self.taken) = (Some(why), None, None, None);
    }

    fn reopen(&mut self) {
        self.fault = None;
        self.counts.reopened += 1;
    }
}

fn lost(error: &io::Error) -> String {
    format!("it was lost, and is reopened when it is connected again: {error}")
}

/// Locks a mutex, also after a panic elsewhere: each value is stored only when it is complete.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
