//! Terminals and devices of this machine: found, opened, read without waiting.

mod found;
#[cfg(unix)]
mod open;
#[cfg(unix)]
mod terminal;

pub use found::{Candidate, gamepads, space_mice};
#[cfg(unix)]
pub use open::{Opened, Wait, wait};
#[cfg(unix)]
pub use terminal::Terminal;
