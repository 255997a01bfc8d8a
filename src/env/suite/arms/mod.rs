//! Arms at a table.

mod delivery;
mod pick_place;
mod push;
mod reach;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] =
    &[("reach", reach::build), ("push", push::build), ("pick_place", pick_place::build)];
