//! What an improvement did to a policy.

use super::actor::Actor;
use crate::nets::{Tape, gaussian};

/// What an improvement did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Update {
    /// Mean divergence of the policy that collected from the new one.
    pub divergence: f64,
    /// Mean entropy of the new policy.
    pub entropy: f64,
    /// Share of the samples of the last pass whose ratio was beyond the clip.
    pub clipped: f64,
    /// Passes made.
    pub epochs: usize,
}

/// The mean divergence of a Gaussian policy, given by its means of these observations and its deviations, from the present one.
pub fn divergence(actor: &Actor, [means, log_std]: [&[f32]; 2], input: &[f32]) -> f64 {
    let (actions, mut tape) = (actor.actions(), Tape::default());
    actor.forward(input, &mut tape);
    let pairs = rows(means, tape.output(), actions);
    let each =
        pairs.map(|(old, new)| f64::from(gaussian::divergence([old, log_std], [new, actor.parts().1])));
    each.sum::<f64>() / tape.rows().max(1) as f64
}

/// Rows of two matrices side by side.
pub fn rows<'a>(a: &'a [f32], b: &'a [f32], width: usize) -> impl Iterator<Item = (&'a [f32], &'a [f32])> {
    a.chunks_exact(width).zip(b.chunks_exact(width))
}
