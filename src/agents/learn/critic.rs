//! The expected return of a state: a network fitted to returns, which are normalised by all that were seen.

use super::fit::Fit;
use crate::archive::Entry;
use crate::nets::{Activation, Adam, Mlp, Running, Tape};
use random::{BitGenerator, Generator};

/// A value function in training.
#[derive(Clone, Debug, PartialEq)]
pub struct Critic {
    /// From what is observed, normalised, to the normalised return.
    pub net: Mlp,
    /// Returns seen so far.
    pub returns: Running,
    /// Parameters of the network.
    pub parameters: Vec<f32>,
    /// Its optimiser.
    pub adam: Adam,
}

impl Critic {
    /// A value function before training, with hidden layers of these widths.
    pub fn new(
        observed: usize,
        hidden: &[usize],
        activation: Activation,
        rng: &mut Generator<impl BitGenerator>,
    ) -> Self {
        let widths: Vec<usize> = [&[observed], hidden, &[1]].concat();
        let net = Mlp::new(&widths, activation, false);
        let parameters = net.draw(1.0, rng);
        Critic { returns: Running::new(1), adam: Adam::new(net.parameters()), parameters, net }
    }

    /// All that is learnt, by names.
    pub(crate) fn entries(&mut self) -> Vec<Entry<'_>> {
        let (layers, _) = self.net.entries(&mut self.parameters);
        let mut entries: Vec<_> = layers.into_iter().map(|entry| entry.of("layers")).collect();
        entries.extend(self.returns.entries().map(|entry| entry.of("returns")));
        entries.extend(self.adam.entries().map(|entry| entry.of("adam")));
        entries.into_iter().map(|entry| entry.of("values")).collect()
    }

    /// Expected returns of normalised observations.
    pub fn values(&self, input: &[f32]) -> Vec<f64> {
        let mut tape = Tape::default();
        self.net.forward(&self.parameters, input, &mut tape);
        let (mean, deviation) = self.scale();
        tape.output().iter().map(|value| f64::from(*value) * deviation + mean).collect()
    }

    /// Takes returns in and fits the network to them by least squares; gives the share of their variance that it explains
    /// before.
    ///
    /// # Panics
    /// There are not as many rows as returns.
    pub fn fit(
        &mut self,
        input: &[f32],
        returns: &[f64],
        fit: Fit,
        rng: &mut Generator<impl BitGenerator>,
    ) -> f64 {
        let explained = explained(&self.values(input), returns);
        self.returns.observe(returns);
        let (mean, deviation) = self.scale();
        let wanted: Vec<f32> = returns.iter().map(|value| ((value - mean) / deviation) as f32).collect();
        fit.least_squares(&self.net, &mut self.parameters, &mut self.adam, [input, &wanted], rng);
        explained
    }

    fn scale(&self) -> (f64, f64) {
        (self.returns.means()[0], self.returns.deviations().next().unwrap_or(1.0))
    }
}

/// The share of the variance of `returns` that `values` explain: 1 is all of it.
fn explained(values: &[f64], returns: &[f64]) -> f64 {
    let count = returns.len().max(1) as f64;
    let mean = returns.iter().sum::<f64>() / count;
    let total: f64 = returns.iter().map(|value| (value - mean) * (value - mean)).sum();
    let left: f64 = returns.iter().zip(values).map(|(value, guess)| (value - guess) * (value - guess)).sum();
    if total > 0.0 { 1.0 - left / total } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_explains_returns() {
        let mut rng = Generator::pcg64(5_u64);
        let input: Vec<f32> = (0..600).map(|_| rng.random() as f32 * 2.0 - 1.0).collect();
        let returns: Vec<f64> =
            input.chunks(2).map(|row| 300.0 + 40.0 * f64::from(row[0] * row[0] - row[1])).collect();
        let mut critic = Critic::new(2, &[16, 16], Activation::Tanh, &mut rng);
        let fit = Fit { epochs: 60, batch: 32, rate: 3e-3, longest: 1.0 };
        let before = critic.fit(&input, &returns, fit, &mut rng);
        let after = explained(&critic.values(&input), &returns);
        assert!(before < 0.1 && after > 0.97, "{before} {after}");
    }
}
