//! Behaviour cloning: the policy under which a teacher's actions are most likely (Pomerleau, 1989).

use super::actor::Actor;
use super::batch::Batch;
use super::fit::Fit;
use super::update::{Update, divergence};
use crate::nets::{Adam, Tape, gaussian};
use random::{BitGenerator, Generator};

/// Brings means nearer to what was demonstrated, by least squares, and gives the deviations that are left: both are the most likely
/// ones, since deviations do not depend on the state.
pub fn update(
    fit: &Fit,
    actor: &mut Actor,
    adam: &mut Adam,
    shown: &Batch,
    rng: &mut Generator<impl BitGenerator>,
) -> Update {
    let (actions, parameters) = (actor.actions(), actor.net.parameters());
    let mut tape = Tape::default();
    actor.forward(&shown.input, &mut tape);
    let (old_means, old_log_std) = (tape.output().to_vec(), actor.parts().1.to_vec());
    fit.least_squares(&actor.net, &mut actor.parameters, adam, [&shown.input, &shown.actions], rng);
    actor.forward(&shown.input, &mut tape);
    let log_std = log_deviations(tape.output(), &shown.actions, actions);
    actor.parameters[parameters..].copy_from_slice(&log_std);
    actor.limit();
    Update {
        divergence: divergence(actor, [&old_means, &old_log_std], &shown.input),
        entropy: f64::from(gaussian::entropy(actor.parts().1)),
        clipped: 0.0,
        epochs: fit.epochs,
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
    use super::super::actor::Head;
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
        let head = Head::Gaussian { log_std: 0.0, least: -3.0 };
        let mut actor = Actor::new([1, 1], &[16, 16], Activation::Tanh, head, &mut rng);
        let mut adam = Adam::new(actor.parameters.len());
        let fit = Fit { epochs: 40, batch: 64, rate: 3e-3, longest: 10.0 };
        let done = update(&fit, &mut actor, &mut adam, &shown, &mut rng);
        let (places, mut tape) = ([-0.8, -0.2, 0.3, 0.9], Tape::default());
        actor.forward(&places, &mut tape);
        for (x, mean) in places.iter().zip(tape.output()) {
            assert!((mean - bent(*x)).abs() < 0.05, "{x}: {mean}");
        }
        assert!((actor.parts().1[0] - 0.2_f32.ln()).abs() < 0.1, "{:?}", actor.parts().1);
        assert!(done.divergence > 0.5 && done.epochs == 40);
    }
}
