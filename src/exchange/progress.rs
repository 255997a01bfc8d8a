//! How far long work is.

/// What [`Progress`] that says "stop" makes of the work: the message of its error.
pub const STOPPED: &str = "stopped by the caller";

/// Is called with the episodes that are done and those that there are; `false` stops the work.
pub type Progress<'a> = &'a mut dyn FnMut(usize, usize) -> bool;
