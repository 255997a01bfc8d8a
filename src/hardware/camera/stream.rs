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
/// How long the thread waits for a frame before it looks whether it is still needed.
const WAIT: Duration = Duration::from_millis(50);
/// Time between two attempts to open a camera that was lost \[s\].
const AGAIN: f64 = 1.0;

/// What became of a stream's frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Frames that came.
    pub frames: u64,
    /// Frames that the camera numbered and nobody got.
    pub dropped: u64,
    /// Frames that the camera's driver called damaged; they are not shown.
    pub damaged: u64,
    /// Times that the camera was lost and opened again.
    pub reopened: u64,
}

/// A stream, of which the newest frame is kept.
pub(super) struct Stream {
    format: Format,
    /// Whether its first frames are to be thrown away.
    settles: bool,
    stale: f64,
    newest: Arc<Mutex<Newest>>,
    intake: Intake,
}

/// Who takes frames from the camera.
enum Intake {
    /// A thread, in real time.
    Thread { wanted: Arc<AtomicBool>, thread: Option<JoinHandle<()>> },
    /// Whoever asks for the newest one, where time is virtual.
    Asked(Box<Source>),
}

#[derive(Default)]
struct Newest {
    bytes: Vec<u8>,
    /// When it came \[s\], on the clock of the setup.
    time: Option<f64>,
    sequence: Option<u32>,
    /// Why none come.
    fault: Option<String>,
    counts: Counts,
}

/// A camera, opened again when it was lost.
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

    /// Returns when so many frames have come and one more; of a camera that need not settle, when one has.
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
                    "{came} frames came in {:.0} s; another program may use it, or its cable may be too slow",
                    FIRST + f64::from(frames) / self.format.rate
                )));
            }
            clock.wait(1.0 / self.format.rate);
        }
    }

    /// Has the newest frame decoded.
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
            .map_err(|why| Fault::Unreachable(format!("its newest frame cannot be shown: {why}")))
    }

    /// Takes what has come, where no thread does.
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
                // It has nothing to say: what it found is in `newest`.
                let _ = thread.join();
            }
        }
    }
}

impl Source {
    /// Waits for the next frame and puts it in its place; whether one came.
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

    /// Opens the camera again, if it was not tried a moment ago.
    fn reopen(&mut self, wait: Duration, place: &Mutex<Newest>) {
        if self.clock.now() - self.lost < AGAIN {
            // A virtual clock is moved by somebody else.
            std::thread::sleep(wait);
            return;
        }
        self.lost = self.clock.now();
        match self.captures.open(&self.name, &self.request) {
            Ok(capture) if capture.format() == self.format => {
                self.capture = Some(capture);
                lock(place).reopen();
            }
            Ok(_) => lock(place).lose("it came back with another format; start again".to_owned()),
            Err(fault) => lock(place).lose(format!("it was lost: {fault}")),
        }
    }
}

impl Newest {
    fn put(&mut self, frame: &Frame, now: f64) {
        let step = self.sequence.map_or(1, |before| frame.sequence.wrapping_sub(before));
        // A camera that counts backwards has begun again.
        if step > 1 && step < u32::MAX / 2 {
            self.counts.dropped += u64::from(step - 1);
        }
        self.sequence = Some(frame.sequence);
        self.counts.frames += 1;
        if frame.damaged {
            self.counts.damaged += 1;
            return;
        }
        self.bytes.clear();
        self.bytes.extend_from_slice(frame.bytes);
        self.time = Some(now);
    }

    fn lose(&mut self, why: String) {
        (self.fault, self.time, self.sequence) = (Some(why), None, None);
    }

    fn reopen(&mut self) {
        self.fault = None;
        self.counts.reopened += 1;
    }
}

fn lost(error: &io::Error) -> String {
    format!("it was lost, and is opened again when it is back: {error}")
}

/// What a mutex holds. A panic elsewhere leaves whole values, since each is put in place when it is complete.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
