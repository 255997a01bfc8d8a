//! Readings that arrive late: what the sensors said, by time, in memory that is allocated once.

use crate::keeper::Keeper;

/// Part of a time step by which times may differ and still be the same.
const SAME: f64 = 1e-6;

/// What the sensors said in the last time steps.
#[derive(Clone, Debug)]
pub(crate) struct Delay {
    /// Age of a reading, in time steps.
    steps: usize,
    /// Largest further age, in time steps.
    jitter: usize,
    width: usize,
    times: Vec<f64>,
    /// One row for each time.
    values: Vec<f64>,
    /// Row of the newest entry; rows before it are older, cyclically.
    newest: usize,
    filled: usize,
    /// Time of the last entry that was given out.
    delivered: f64,
}

impl Delay {
    /// A delay of `steps` and up to `jitter` more time steps for readings of `width` values.
    pub(crate) fn new(steps: usize, jitter: usize, width: usize) -> Self {
        let rows = steps + jitter + 2;
        Delay {
            steps,
            jitter,
            width,
            times: vec![0.0; rows],
            values: vec![0.0; rows * width],
            newest: 0,
            filled: 0,
            delivered: f64::NEG_INFINITY,
        }
    }

    /// Makes readings of another age, at most as old as when it was made.
    pub(crate) fn set_steps(&mut self, steps: usize) {
        self.steps = steps.min(self.oldest());
    }

    /// The age that there is memory for, in time steps.
    fn oldest(&self) -> usize {
        self.times.len() - self.jitter - 2
    }

    /// Writes it, or reads one that was made for as many steps.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        let mut steps = self.steps;
        keeper.count(&mut steps);
        self.set_steps(steps);
        keeper.numbers(&mut self.times);
        keeper.numbers(&mut self.values);
        let (mut newest, mut filled) = (self.newest, self.filled);
        keeper.count(&mut newest);
        keeper.count(&mut filled);
        (self.newest, self.filled) = (newest % self.times.len(), filled.min(self.times.len()));
        keeper.number(&mut self.delivered);
    }

    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.filled = 0;
        self.delivered = f64::NEG_INFINITY;
    }

    /// Stores what the sensors say at `time`; a second time replaces the first.
    pub(crate) fn record(&mut self, time: f64, values: &[f64]) {
        if self.filled > 0 && time < self.times[self.newest] {
            self.clear();
        }
        if self.filled == 0 || time > self.times[self.newest] {
            self.newest = (self.newest + 1) % self.times.len();
            self.filled = (self.filled + 1).min(self.times.len());
        }
        self.times[self.newest] = time;
        self.values[self.newest * self.width..][..self.width].copy_from_slice(values);
    }

    /// Writes the newest values that are at least as old as the delay and `jitter` more time steps of `step` seconds, the
    /// oldest if none is; never older ones than before. Returns their time.
    pub(crate) fn deliver(&mut self, step: f64, jitter: usize, values: &mut [f64]) -> f64 {
        let lag = (self.steps + jitter) as f64;
        let due = self.times[self.newest] - (lag - SAME) * step;
        let rows = self.times.len();
        let by_age = |age: usize| (self.newest + rows - age) % rows;
        let arrived = |row: usize| self.times[row] <= due || self.times[row] <= self.delivered;
        let oldest = self.filled.saturating_sub(1);
        let row = by_age((0..oldest).find(|&age| arrived(by_age(age))).unwrap_or(oldest));
        self.delivered = self.times[row];
        values.copy_from_slice(&self.values[row * self.width..][..self.width]);
        self.delivered
    }

    /// Largest jitter, in time steps.
    pub(crate) fn jitter(&self) -> usize {
        self.jitter
    }
}
