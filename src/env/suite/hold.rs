//! States that a task wants to be held for some time.

use crate::rows::Rows;
use crate::task::Verdict;
use robot::Keeper;

/// For how long a condition has held.
#[derive(Clone)]
pub struct Hold {
    /// How long it is to hold \[s\].
    wanted: f64,
    /// Steps before the present state, one after the other, in which it held.
    steps: usize,
}

impl Hold {
    /// A condition that is to hold for `wanted` seconds.
    pub fn new(wanted: f64) -> Self {
        Hold { wanted, steps: 0 }
    }

    /// Begins an episode.
    pub fn begin(&mut self) {
        self.steps = 0;
    }

    /// Counts the state that a step is about to leave.
    pub fn leave(&mut self, holds: bool) {
        self.steps = if holds { self.steps + 1 } else { 0 };
    }

    /// Seconds for which the condition has held without a break, up to a state in which it holds or not.
    pub fn seconds(&self, holds: bool, dt: f64) -> f64 {
        if holds { self.steps as f64 * dt } else { 0.0 }
    }

    /// Writes the terms `held` and `bonus` of a reward, and decides the episode: it is solved, and ends, when the condition has held
    /// long enough; it ends too where it is `lost`.
    pub fn judge(&self, seconds: f64, holds: bool, lost: bool, terms: &mut Rows) -> Verdict {
        // Sums of steps may miss the time by rounding.
        let solved = holds && seconds > self.wanted - 1e-9;
        terms.set("held", "", [f64::from(holds)]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("penalty", "", [f64::from(lost)]);
        Verdict { sparse: f64::from(holds), solved, done: solved || lost }
    }

    /// Writes, or reads, what it counts.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        keeper.count(&mut self.steps);
    }
}
