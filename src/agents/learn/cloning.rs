//! Behaviour cloning: the policy under which a teacher's actions are most likely (Pomerleau, 1989).

use super::actor::Actor;
use super::batch::Batch;
use super::ppo::{Update, divergence};
use super::shuffle::Minibatches;
use crate::nets::{Adam, Tape, clip, gaussian};
use random::{BitGenerator, Generator};
use serde::{Deserialize, Serialize};

/// Settings of an update.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cloning {
    /// Passes over the demonstrations.
    pub epochs: usize,
    /// Their steps in a step of the optimiser.
    pub batch: usize,
    /// Size of a step of the optimiser.
    pub rate: f32,
    /// Longest gradient.
    pub longest: f64,
}

/// Brings means nearer to what was demonstrated, by least squares, and gives the deviations that are left: both are the most likely
/// ones, since deviations do not depend on the state.
pub fn update(
    cloning: &Cloning,
    actor: &mut Actor,
    adam: &mut Adam,
    shown: &Batch,
    rng: &mut Generator<impl BitGenerator>,
) -> Update {
    let (actions, parameters) = (actor.actions(), actor.net.parameters());
    let mut tape = Tape::default();
    actor.means(&shown.input, &mut tape);
    let (old_means, old_log_std) = (tape.output().to_vec(), actor.parts().1.to_vec());
    let mut batches = Minibatches::new(shown.actions.len() / actions, cloning.batch);
    let mut gradient = vec![0.0; actor.parameters.len()];
    for _ in 0..cloning.epochs {
        batches.shuffle(rng);
        for rows in batches.iter() {
            actor.means(&batches.gather(rows, &shown.input), &mut tape);
            let (wanted, share) = (batches.gather(rows, &shown.actions), 1.0 / rows.len() as f32);
            let pairs = tape.output().iter().zip(&wanted);
            let slopes: Vec<f32> = pairs.map(|(mean, action)| (mean - action) * share).collect();
            gradient.fill(0.0);
            actor.net.backward(actor.parts().0, &tape, &slopes, &mut gradient[..parameters]);
            clip(&mut gradient, cloning.longest);
            adam.step(cloning.rate, 0.0, &gradient, &mut actor.parameters);
        }
    }
    actor.means(&shown.input, &mut tape);
    let log_std = log_deviations(tape.output(), &shown.actions, actions);
    actor.parameters[parameters..].copy_from_slice(&log_std);
    actor.limit();
    Update {
        divergence: divergence(actor, [&old_means, &old_log_std], &shown.input),
        entropy: f64::from(gaussian::entropy(actor.parts().1)),
        clipped: 0.0,
        epochs: cloning.epochs,
    }
}

/// Logarithms of the root mean squares of what means are away from actions, for each of `width` actions.
fn log_deviations(means: &[f32], actions: &[f32], width: usize) -> Vec<f32> {
    let steps = (actions.len() / width).max(1) as f64;
    let squares = |k: usize| {
        let pairs = means.iter().zip(actions).skip(k).step_by(width);
        pairs.map(|(mean, action)| f64::from(mean - action).powi(2)).sum::<f64>()
    };
    // Where all are met, the least deviation of the policy limits what is left.
    (0..width).map(|k| (0.5 * libm::log((squares(k) / steps).max(f64::MIN_POSITIVE))) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nets::Activation;

    /// A teacher with a deviation of 0.2 about a bent line.
    #[test]
    fn a_clone_has_the_means_and_the_deviation_of_its_teacher() {
        let mut rng = Generator::pcg64(4_u64);
        let input: Vec<f32> = (0..2000).map(|_| rng.random() as f32 * 2.0 - 1.0).collect();
        let bent = |x: f32| x * x - 0.5 * x;
        let actions = input.iter().map(|x| bent(*x) + 0.2 * rng.standard_normal() as f32).collect();
        let shown = Batch { input, actions, ..Batch::default() };
        let mut actor = Actor::new([1, 1], &[16, 16], Activation::Tanh, 0.0, &mut rng);
        actor.least_log_std = -3.0;
        let mut adam = Adam::new(actor.parameters.len());
        let cloning = Cloning { epochs: 40, batch: 64, rate: 3e-3, longest: 10.0 };
        let done = update(&cloning, &mut actor, &mut adam, &shown, &mut rng);
        let (places, mut tape) = ([-0.8, -0.2, 0.3, 0.9], Tape::default());
        actor.means(&places, &mut tape);
        for (x, mean) in places.iter().zip(tape.output()) {
            assert!((mean - bent(*x)).abs() < 0.05, "{x}: {mean}");
        }
        assert!((actor.parts().1[0] - 0.2_f32.ln()).abs() < 0.1, "{:?}", actor.parts().1);
        assert!(done.divergence > 0.5 && done.epochs == 40);
    }
}
