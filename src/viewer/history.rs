//! States that the simulation has been in.

use physics::{Data, Model, Snapshot};
use std::collections::VecDeque;

/// Most states that are kept.
const STATES: usize = 2000;
/// Most bytes that they take.
const BYTES: usize = 100_000_000;

/// The latest states, the oldest first, and where in them the simulation stands.
#[derive(Clone, Debug, Default)]
pub struct History {
    states: VecDeque<Snapshot>,
    capacity: usize,
    /// States after the one that is shown.
    behind: usize,
}

impl History {
    /// An empty history for states of this model.
    pub fn of(model: &Model) -> Self {
        let bytes = Snapshot::bytes(model).max(1);
        History { states: VecDeque::new(), capacity: (BYTES / bytes).clamp(1, STATES), behind: 0 }
    }

    /// Number of states.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.states.is_empty()
    }

    /// How many states the one that is shown lies behind the latest.
    pub fn behind(&self) -> usize {
        self.behind
    }

    /// Adds the present state; the states after the one that is shown are dropped.
    pub fn push(&mut self, data: &Data) {
        self.states.truncate(self.states.len() - self.behind);
        self.behind = 0;
        let full = self.states.len() >= self.capacity;
        let mut snapshot =
            if full { self.states.pop_front().unwrap_or_default() } else { Snapshot::default() };
        data.save(&mut snapshot);
        self.states.push_back(snapshot);
    }

    /// The state that lies `behind` the latest, or the oldest.
    pub fn go_to(&mut self, behind: usize) -> Option<&Snapshot> {
        let last = self.states.len().checked_sub(1)?;
        self.behind = behind.min(last);
        self.states.get(last - self.behind)
    }
}
