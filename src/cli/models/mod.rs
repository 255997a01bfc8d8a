//! Commands that work on models.

pub mod bench;
pub mod check;
pub mod compile;
pub mod convert;
pub mod fields;
pub mod identify;
pub mod inspect;
pub mod sim;
pub mod trace;
pub mod world;

/// Most steps that one run takes.
pub const MAX_STEPS: u64 = 1_000_000_000;
