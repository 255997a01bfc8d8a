//! The tasks of the MyoChallenges of 2022 and 2023.

pub(super) mod baoding;
pub(super) mod chase_tag;
mod die;
mod object;
pub(super) mod relocate;
pub(super) mod reorient;
