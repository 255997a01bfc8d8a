//! Networks fitted by least squares, in minibatches.

use super::shuffle::Minibatches;
use crate::nets::{Adam, Mlp, Tape, clip};
use random::{BitGenerator, Generator};
use serde::{Deserialize, Serialize};

/// How a network is fitted.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// Passes over the samples.
    pub epochs: usize,
    /// Samples of a step.
    pub batch: usize,
    /// Size of a step.
    pub rate: f32,
    /// Longest gradient.
    pub longest: f64,
}

impl Fit {
    /// Brings what a network gives for the rows of an input nearer to what is wanted. Parameters after those of the network stay as
    /// they are.
    pub(super) fn least_squares(
        &self,
        net: &Mlp,
        parameters: &mut [f32],
        adam: &mut Adam,
        [input, wanted]: [&[f32]; 2],
        rng: &mut Generator<impl BitGenerator>,
    ) {
        let (own, mut tape, mut gradient) = (net.parameters(), Tape::default(), vec![0.0; parameters.len()]);
        let mut batches = Minibatches::new(wanted.len() / net.outputs(), self.batch);
        for _ in 0..self.epochs {
            batches.shuffle(rng);
            for rows in batches.iter() {
                net.forward(&parameters[..own], &batches.gather(rows, input), &mut tape);
                let (wanted, share) = (batches.gather(rows, wanted), 1.0 / rows.len() as f32);
                let pairs = tape.output().iter().zip(&wanted);
                let slopes: Vec<f32> = pairs.map(|(given, wanted)| (given - wanted) * share).collect();
                gradient.fill(0.0);
                net.backward(&parameters[..own], &tape, &slopes, &mut gradient[..own]);
                clip(&mut gradient, self.longest);
                adam.step(self.rate, 0.0, &gradient, parameters);
            }
        }
    }
}
