//! Signals that ask a run to end.

use signal_hook::consts::signal;
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
const SIGNALS: [i32; 3] = [signal::SIGINT, signal::SIGTERM, signal::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [signal::SIGINT, signal::SIGTERM];

/// Notes the first signal, so that a run can complete its files; a second one ends the process at once.
#[derive(Clone)]
pub struct Interrupt(Arc<AtomicUsize>);

impl Interrupt {
    /// Starts to listen.
    ///
    /// # Errors
    /// The system refuses.
    pub fn listen() -> io::Result<Self> {
        let (asked, again) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        for number in SIGNALS {
            // In this order: the first signal sets what the second finds.
            flag::register_conditional_default(number, again.clone())?;
            flag::register(number, again.clone())?;
            flag::register_usize(number, asked.clone(), number as usize)?;
        }
        Ok(Interrupt(asked))
    }

    /// The exit code of a process that a signal has asked to end, by the convention of shells.
    pub fn code(&self) -> Option<u8> {
        match self.0.load(Ordering::Relaxed) {
            0 => None,
            number => Some(128 + number as u8),
        }
    }
}
