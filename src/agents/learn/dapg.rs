//! The natural policy gradient with demonstrations beside what the policy collects (Rajeswaran et al., 2018, section IV): cloning first, and
//! then a share in every gradient that fades.

use super::actor::Actor;
use super::batch::Batch;
use super::fit::Fit;
use super::npg;
use super::update::Update;
use serde::{Deserialize, Serialize};

/// Settings of an update.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Dapg {
    /// Size of a step δ: twice the divergence that it makes, to second order.
    pub step: f64,
    /// Weight λ₀ of a step of a demonstration at first, as a share of the largest advantage.
    pub weight: f64,
    /// What becomes λ₁ of it from one iteration to the next.
    pub decay: f64,
    /// How the policy is cloned before the first iteration.
    pub cloning: Fit,
}

/// Improves a policy by a batch that it collected in an iteration, from 0, and by demonstrations.
pub fn update(dapg: &Dapg, iteration: u64, actor: &mut Actor, batch: &Batch, shown: &Batch) -> Update {
    let most = batch.advantages.iter().copied().fold(0.0, f64::max);
    // A product in a fixed order has the same bits everywhere.
    let weight = (0..iteration).fold(dapg.weight * most, |weight, _| weight * dapg.decay);
    let demonstrated = shown.actions.len() / actor.actions();
    let share = 1.0 / (batch.steps() + demonstrated).max(1) as f64;
    let own = batch.advantages.iter().map(|advantage| advantage * share);
    let weights: Vec<f64> = own.chain((0..demonstrated).map(|_| weight * share)).collect();
    let input = [&batch.input[..], &shown.input].concat();
    let taken = [&batch.actions[..], &shown.actions].concat();
    npg::climb(dapg.step, actor, [&input, &taken], &weights, batch.steps())
}

#[cfg(test)]
mod tests {
    use super::super::actor::Head;
    use super::*;
    use crate::nets::{Activation, Tape};
    use random::Generator;

    /// Where advantages are noise, demonstrations decide where a step goes; after their weight has faded they do not.
    #[test]
    fn demonstrations_pull_until_they_fade() {
        let mut rng = Generator::pcg64(8_u64);
        let mut numbers = |len: usize| -> Vec<f32> { (0..len).map(|_| rng.random() as f32 - 0.5).collect() };
        let (input, actions, shown) = (numbers(400), numbers(400), numbers(400));
        let advantages = (0..400).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let batch = Batch { input, actions, advantages, returns: vec![0.0; 400] };
        let shown = Batch { actions: vec![0.4; shown.len()], input: shown, ..Batch::default() };
        let cloning = Fit { epochs: 0, batch: 1, rate: 1e-3, longest: 1.0 };
        let dapg = Dapg { step: 0.05, weight: 1.0, decay: 0.5, cloning };
        let head = Head::Gaussian { log_std: -0.5, least: f32::NEG_INFINITY };
        let actor = Actor::new([1, 1], &[8], Activation::Tanh, head, &mut Generator::pcg64(1_u64));
        let moved = |iteration: u64| {
            let (mut actor, mut tape) = (actor.clone(), Tape::default());
            let update = update(&dapg, iteration, &mut actor, &batch, &shown);
            actor.forward(&shown.input, &mut tape);
            assert!(update.divergence > 0.2 * dapg.step && update.divergence < dapg.step, "{update:?}");
            tape.output().iter().sum::<f32>() / 400.0
        };
        let (first, last) = (moved(0), moved(40));
        assert!(first > 0.08 && last < first - 0.1, "{first} {last}");
    }
}
