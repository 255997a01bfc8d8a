//! Proximal policy optimisation (Schulman et al., 2017, equation 7 and algorithm 1), with the value function apart from the policy.

use super::actor::Actor;
use super::batch::Batch;
use super::shuffle::Minibatches;
use super::update::{Update, divergence, rows};
use crate::nets::{Adam, Tape, clip, gaussian};
use random::{BitGenerator, Generator};
use serde::{Deserialize, Serialize};

/// Settings of an update of the policy.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Ppo {
    /// Passes over the batch.
    pub epochs: usize,
    /// Steps of the batch in a step of the optimiser.
    pub batch: usize,
    /// Size of a step of the optimiser.
    pub rate: f32,
    /// How far the ratio of densities counts beyond 1, to either side.
    pub clip: f32,
    /// Weight of the entropy.
    pub entropy: f32,
    /// Longest gradient.
    pub longest: f64,
    /// Divergence from the policy that collected, beyond which no further pass is made.
    pub divergence: f64,
}

/// Improves a policy by a batch that it collected.
pub fn update(
    ppo: &Ppo,
    actor: &mut Actor,
    adam: &mut Adam,
    batch: &Batch,
    rng: &mut Generator<impl BitGenerator>,
) -> Update {
    let (actions, mut tape) = (actor.actions(), Tape::default());
    actor.forward(&batch.input, &mut tape);
    let (old_means, old_log_std) = (tape.output().to_vec(), actor.parts().1.to_vec());
    let old: Vec<f32> = rows(&old_means, &batch.actions, actions)
        .map(|(mean, action)| gaussian::log_density(mean, &old_log_std, action))
        .collect();
    let mut batches = Minibatches::new(batch.steps(), ppo.batch);
    let mut gradient = vec![0.0; actor.parameters.len()];
    let mut outcome = Update::default();
    for _ in 0..ppo.epochs {
        batches.shuffle(rng);
        let mut clipped = 0;
        for chosen in batches.iter() {
            actor.forward(&batches.gather(chosen, &batch.input), &mut tape);
            let (taken, log_std) = (batches.gather(chosen, &batch.actions), actor.parts().1);
            let mut slopes = vec![0.0; taken.len()];
            let mut by_log_std = vec![-ppo.entropy; actions];
            let steps =
                rows(tape.output(), &taken, actions).zip(slopes.chunks_exact_mut(actions)).zip(chosen);
            for (((mean, action), by_mean), &step) in steps {
                let advantage = batch.advantages[step] as f32;
                let ratio = crate::nets::exp(gaussian::log_density(mean, log_std, action) - old[step]);
                let beyond = if advantage > 0.0 { ratio > 1.0 + ppo.clip } else { ratio < 1.0 - ppo.clip };
                clipped += usize::from(beyond);
                if !beyond {
                    let weight = -advantage * ratio / chosen.len() as f32;
                    gaussian::add_slopes(weight, [mean, log_std], action, [by_mean, &mut by_log_std]);
                }
            }
            gradient.fill(0.0);
            let (by_net, last) = gradient.split_at_mut(actor.net.parameters());
            actor.net.backward(actor.parts().0, &tape, &slopes, by_net);
            last.copy_from_slice(&by_log_std);
            clip(&mut gradient, ppo.longest);
            adam.step(ppo.rate, 0.0, &gradient, &mut actor.parameters);
            actor.limit();
        }
        outcome.epochs += 1;
        outcome.clipped = clipped as f64 / batch.steps().max(1) as f64;
        outcome.divergence = divergence(actor, [&old_means, &old_log_std], &batch.input);
        if outcome.divergence > ppo.divergence {
            break;
        }
    }
    outcome.entropy = f64::from(gaussian::entropy(actor.parts().1));
    outcome
}
