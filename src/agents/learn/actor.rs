//! A policy in training: a network from what is observed to a distribution of actions.

use crate::archive::{Entry, Numbers};
use crate::nets::{Activation, Mlp, Running, Squashed, Tape, gaussian};
use env::Rng;

/// How much smaller the weights of the last layer start, so that first actions are near the middle of their ranges.
const LAST: f32 = 0.01;

/// Which distribution of actions a policy has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Head {
    /// Gaussian: the network gives the means, and the deviations are parameters that do not depend on the state.
    Gaussian {
        /// Logarithm of the deviations at first.
        log_std: f32,
        /// Least logarithm of a deviation.
        least: f32,
    },
    /// Gaussian with means and deviations of the network, and squashed into (-1, 1).
    Squashed(Squashed),
}

/// A policy in training.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// From what is observed, normalised, to what decides the distribution.
    pub net: Mlp,
    /// What was observed so far, by which observations are normalised.
    pub seen: Running,
    /// Parameters of the network, then the logarithms of deviations that do not depend on the state.
    pub parameters: Vec<f32>,
    /// The distribution.
    pub head: Head,
}

impl Head {
    /// How many numbers decide the distribution of `actions` actions.
    pub fn outputs(&self, actions: usize) -> usize {
        match self {
            Head::Gaussian { .. } => actions,
            Head::Squashed(_) => actions.saturating_mul(2),
        }
    }
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
        head: Head,
        rng: &mut Rng,
    ) -> Self {
        let widths: Vec<usize> = [&[observed], hidden, &[head.outputs(actions)]].concat();
        let net = Mlp::new(&widths, activation, false);
        let mut parameters = net.draw(LAST, rng);
        if let Head::Gaussian { log_std, .. } = head {
            parameters.extend((0..actions).map(|_| log_std));
        }
        Actor { net, seen: Running::new(observed), parameters, head }
    }

    /// All that is learnt, by names.
    pub(crate) fn entries(&mut self) -> Vec<Entry<'_>> {
        let (layers, log_std) = self.net.entries(&mut self.parameters);
        let mut entries: Vec<_> = layers.into_iter().map(|entry| entry.of("layers")).collect();
        if !log_std.is_empty() {
            entries.push(Entry::new("log_std", Numbers::F32(log_std)));
        }
        entries.extend(self.seen.entries().map(|entry| entry.of("observed")));
        entries.into_iter().map(|entry| entry.of("policy")).collect()
    }

    /// Number of actions.
    pub fn actions(&self) -> usize {
        match self.head {
            Head::Gaussian { .. } => self.net.outputs(),
            Head::Squashed(_) => self.net.outputs() / 2,
        }
    }

    /// Parameters of the network, and logarithms of the deviations that do not depend on the state.
    pub fn parts(&self) -> (&[f32], &[f32]) {
        self.parameters.split_at(self.net.parameters())
    }

    /// Observations, row after row, as the network takes them.
    pub fn normalized(&self, observations: &[f64]) -> Vec<f32> {
        let mut input = Vec::with_capacity(observations.len());
        self.seen.normalize(observations, &mut input);
        input
    }

    /// Computes what decides the distributions for normalised observations onto a tape: the means, if nothing is squashed.
    pub fn forward(&self, input: &[f32], tape: &mut Tape) {
        self.net.forward(self.parts().0, input, tape);
    }

    /// The mean action by one row of what [`Actor::forward`] computed; the median where actions are squashed.
    pub fn mean(&self, output: &[f32], action: &mut [f32]) {
        match self.head {
            Head::Gaussian { .. } => action.copy_from_slice(output),
            Head::Squashed(head) => head.median(output, action),
        }
    }

    /// Draws an action by one row of what [`Actor::forward`] computed.
    pub fn draw(&self, output: &[f32], rng: &mut Rng, action: &mut [f32]) {
        match self.head {
            Head::Gaussian { .. } => gaussian::draw(output, self.parts().1, rng, action),
            Head::Squashed(head) => {
                let noise: Vec<f32> = action.iter().map(|_| rng.standard_normal() as f32).collect();
                head.act(output, &noise, action);
            }
        }
    }

    /// Keeps deviations that do not depend on the state from falling below the least.
    pub fn limit(&mut self) {
        if let Head::Gaussian { least, .. } = self.head {
            let log_std = &mut self.parameters[self.net.parameters()..];
            log_std.iter_mut().for_each(|log_std| *log_std = log_std.max(least));
        }
    }
}
