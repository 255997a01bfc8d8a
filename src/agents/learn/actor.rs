//! A Gaussian policy: a network gives the mean action, and deviations are parameters that do not depend on the state.

use crate::archive::{Entry, Numbers};
use crate::nets::{Activation, Mlp, Running, Tape};
use random::{BitGenerator, Generator};

/// How much smaller the weights of the last layer start, so that first actions are near the middle of their ranges.
const LAST: f32 = 0.01;

/// A policy in training.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// From what is observed, normalised, to mean actions.
    pub net: Mlp,
    /// What was observed so far, by which observations are normalised.
    pub seen: Running,
    /// Parameters of the network, then the logarithms of the deviations.
    pub parameters: Vec<f32>,
    /// Least logarithm of a deviation.
    pub least_log_std: f32,
}

impl Actor {
    /// A policy before training, with hidden layers of these widths.
    ///
    /// # Panics
    /// A width is zero.
    pub fn new(
        [observed, actions]: [usize; 2],
        hidden: &[usize],
        activation: Activation,
        log_std: f32,
        rng: &mut Generator<impl BitGenerator>,
    ) -> Self {
        let widths: Vec<usize> = [&[observed], hidden, &[actions]].concat();
        let net = Mlp::new(&widths, activation, false);
        let mut parameters = net.draw(LAST, rng);
        parameters.extend((0..actions).map(|_| log_std));
        Actor { net, seen: Running::new(observed), parameters, least_log_std: f32::NEG_INFINITY }
    }

    /// All that is learnt, by names.
    pub(crate) fn entries(&mut self) -> Vec<Entry<'_>> {
        let (layers, log_std) = self.net.entries(&mut self.parameters);
        let mut entries: Vec<_> = layers.into_iter().map(|entry| entry.of("layers")).collect();
        entries.push(Entry::new("log_std", Numbers::F32(log_std)));
        entries.extend(self.seen.entries().map(|entry| entry.of("observed")));
        entries.into_iter().map(|entry| entry.of("policy")).collect()
    }

    /// Number of actions.
    pub fn actions(&self) -> usize {
        self.net.outputs()
    }

    /// Parameters of the network, and logarithms of the deviations.
    pub fn parts(&self) -> (&[f32], &[f32]) {
        self.parameters.split_at(self.net.parameters())
    }

    /// Observations, row after row, as the network takes them.
    pub fn normalized(&self, observations: &[f64]) -> Vec<f32> {
        let mut input = Vec::with_capacity(observations.len());
        self.seen.normalize(observations, &mut input);
        input
    }

    /// Computes mean actions of normalised observations onto a tape.
    pub fn means(&self, input: &[f32], tape: &mut Tape) {
        self.net.forward(self.parts().0, input, tape);
    }

    /// Keeps the deviations from falling below the least.
    pub fn limit(&mut self) {
        let (actions, least) = (self.actions(), self.least_log_std);
        let log_std = self.parameters.iter_mut().rev().take(actions);
        log_std.for_each(|log_std| *log_std = log_std.max(least));
    }
}
