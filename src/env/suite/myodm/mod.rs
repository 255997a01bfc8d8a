//! Muscle-driven hand and arm that follow recorded motions of objects.

mod reference;
mod track;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[("track", track::build)];
