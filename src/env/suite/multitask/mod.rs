//! A kitchen and its appliances.

mod appliance;
mod chore;
mod kitchen;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[("kitchen", kitchen::build), ("appliance", appliance::build)];
