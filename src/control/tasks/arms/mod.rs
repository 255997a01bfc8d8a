//! Arms.

pub mod reach;
