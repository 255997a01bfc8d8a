//! Dexterous manipulation with the Adroit hand.

mod adroit;
mod baoding;
mod door;
mod hammer;
mod pen;
mod relocate;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[
    ("adroit_door", door::build),
    ("adroit_hammer", hammer::build),
    ("adroit_pen", pen::build),
    ("adroit_relocate", relocate::build),
    ("adroit_baoding", baoding::build),
];
