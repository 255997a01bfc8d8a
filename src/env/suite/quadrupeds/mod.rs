//! Four-legged robots.

mod free_walk;
mod kitty;
mod orient;
mod stand;
mod walk;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[
    ("free_walk", free_walk::build),
    ("kitty_walk", walk::build),
    ("kitty_orient", orient::build),
    ("kitty_stand", stand::build),
];
