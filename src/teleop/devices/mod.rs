//! Terminals and devices of this machine: found, opened, read without waiting.

#[cfg(unix)]
mod adb;
mod found;
#[cfg(unix)]
mod open;
#[cfg(unix)]
mod serial;
#[cfg(unix)]
mod terminal;

pub use found::{Candidate, gamepads, space_mice};
#[cfg(unix)]
pub use open::{Opened, Wait, wait};
#[cfg(unix)]
pub use terminal::Terminal;
