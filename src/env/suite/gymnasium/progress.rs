//! How fast a robot moves over a step, and what its controls cost.

use crate::task::Turn;

/// Where the robot was before a step, and the controls that it got.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    before: [f64; 2],
    /// Sum of the squared controls.
    effort: f64,
}

impl Progress {
    /// Starts an episode at a position, without controls.
    pub fn begin(&mut self, position: [f64; 2]) {
        *self = Progress { before: position, effort: 0.0 };
    }

    /// Starts a step at a position. The policy's action becomes the controls as it is.
    pub fn act(&mut self, turn: &mut Turn<'_>, position: [f64; 2]) {
        self.before = position;
        self.effort = turn.wanted.iter().map(|control| control * control).sum();
        turn.action.copy_from_slice(turn.wanted);
        turn.raw = true;
    }

    /// Mean velocity over the step that led to a position \[m/s\].
    pub fn velocity(&self, position: [f64; 2], dt: f64) -> [f64; 2] {
        std::array::from_fn(|k| (position[k] - self.before[k]) / dt)
    }

    /// Sum of the squared controls.
    pub fn effort(&self) -> f64 {
        self.effort
    }
}
