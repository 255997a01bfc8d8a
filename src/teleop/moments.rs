//! States of an episode that a person can go back to.

use crate::handover::Handover;
use crate::pilot::Pilot;
use env::EnvState;

/// All that an episode needs to go on from a state.
#[derive(Clone)]
pub struct Moment {
    /// The environment.
    pub env: EnvState,
    /// What drives it.
    pub pilot: Pilot,
    /// What acts beside the person.
    pub handover: Option<Handover>,
    /// The return up to this state.
    pub reward: f64,
    /// Number of successive solved steps up to this state.
    pub solved: usize,
}

/// The states of an episode, from its reset on, and the one that is shown.
#[derive(Default)]
pub struct Moments {
    all: Vec<Moment>,
    at: usize,
}

impl Moments {
    /// Begins with the state of a reset.
    pub fn begin(&mut self, first: Moment) {
        self.all.clear();
        self.all.push(first);
        self.at = 0;
    }

    /// Adds the state after the one that is shown; those that were gone back over are forgotten.
    pub fn push(&mut self, next: Moment) {
        self.all.truncate(self.at + 1);
        self.all.push(next);
        self.at = self.all.len() - 1;
    }

    /// Goes back or forward by some states, as far as there are any; the state that is shown then, if it is another one.
    pub fn go(&mut self, by: isize) -> Option<&Moment> {
        let to = self.at.saturating_add_signed(by).min(self.all.len().saturating_sub(1));
        if to == self.at {
            return None;
        }
        self.at = to;
        self.all.get(to)
    }

    /// Steps before the state that is shown.
    pub fn at(&self) -> usize {
        self.at
    }

    /// Steps after it that were gone back over.
    pub fn ahead(&self) -> usize {
        self.all.len().saturating_sub(self.at + 1)
    }
}
