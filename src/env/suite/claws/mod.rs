//! Claws that turn an object in hand.

mod reorient;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[("claw_reorient", reorient::build)];
