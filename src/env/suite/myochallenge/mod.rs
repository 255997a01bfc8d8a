//! The tasks of the MyoChallenges of 2022 and 2023.

mod baoding;
mod chase_tag;
mod die;
mod object;
mod relocate;
mod reorient;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] = &[
    ("rotate_balls", baoding::build),
    ("reorient_die", reorient::build),
    ("chase_tag", chase_tag::build),
    ("relocate_object", relocate::build),
];
