//! What happens again after a number of steps: a new command, a push.

use robot::Keeper;
use serde::Deserialize;

/// A number of steps of the environment, at least one, and those since it last passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "usize")]
pub struct Interval {
    every: usize,
    since: usize,
}

impl TryFrom<usize> for Interval {
    type Error = &'static str;

    fn try_from(every: usize) -> Result<Self, Self::Error> {
        if every == 0 {
            Err("0 steps; it has to last a step at least")
        } else {
            Ok(Interval { every, since: 0 })
        }
    }
}

impl Interval {
    /// Counts from here on.
    pub fn restart(&mut self) {
        self.since = 0;
    }

    /// Counts a step; whether the interval has passed with it.
    pub fn passes(&mut self) -> bool {
        self.since = (self.since + 1) % self.every;
        self.since == 0
    }

    /// Writes, or reads, the steps that were counted.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        keeper.count(&mut self.since);
    }
}
