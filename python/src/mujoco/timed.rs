//! How long calls took: MuJoCo's timers of whole steps and passes. What happens inside a call is not timed.

use std::time::Instant;

/// Timers by `mjtTimer`.
const TIMERS: usize = 15;

/// What is timed, by its place in `mjtTimer`.
#[derive(Clone, Copy)]
pub enum Timed {
    Step = 0,
    Forward = 1,
    Inverse = 2,
}

/// Time that calls took [s], and how many there were, since the simulation was made or reset.
#[derive(Clone, Default)]
pub struct Timers {
    pub duration: [f64; TIMERS],
    pub number: [i32; TIMERS],
}

impl Timers {
    /// Counts `number` calls that began at `start` and end now.
    pub fn count(&mut self, what: Timed, number: usize, start: Instant) {
        self.duration[what as usize] += start.elapsed().as_secs_f64();
        self.number[what as usize] = self.number[what as usize].saturating_add(number as i32);
    }
}
