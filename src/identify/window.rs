//! Pieces of logs, each simulated from a state that was recorded.

use crate::log::Log;

/// A piece of a log.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Which log.
    pub log: usize,
    /// First row, whose state it begins in.
    pub first: usize,
    /// One beyond the last row.
    pub end: usize,
}

/// The pieces of logs, of at most a number of seconds where their states were recorded; else whole logs.
pub(crate) fn windows(logs: &[Log], state_width: usize, longest: f64) -> Vec<Window> {
    let mut found = Vec::new();
    for (number, log) in logs.iter().enumerate() {
        let rows = log.rows();
        let known = state_width > 0 && log.states.len() == rows * state_width;
        let mut first = 0;
        while first + 1 < rows {
            let limit = log.times[first] + longest * (1.0 + 1e-9);
            let end = if known { log.times.partition_point(|&t| t <= limit).max(first + 2) } else { rows };
            found.push(Window { log: number, first, end });
            first = end - 1;
        }
    }
    found
}
