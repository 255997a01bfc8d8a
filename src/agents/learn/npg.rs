//! The natural policy gradient with steps of one size (Rajeswaran et al., 2017, algorithm 1; Kakade, 2001).

use super::actor::Actor;
use super::batch::Batch;
use super::update::{Update, divergence};
use crate::nets::{Tape, gaussian};
use serde::{Deserialize, Serialize};

/// Steps of conjugate gradients, and the squared residual at which they end.
const STEPS: usize = 10;
const RESIDUAL: f64 = 1e-10;
/// Added to the Fisher matrix, as a multiple of the identity.
const DAMPING: f64 = 1e-4;

/// Settings of an update.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Npg {
    /// Size of a step δ: twice the divergence that it makes, to second order.
    pub step: f64,
}

/// Improves a policy by a batch that it collected, by a step along the natural gradient.
pub fn update(npg: &Npg, actor: &mut Actor, batch: &Batch) -> Update {
    let weights: Vec<f64> = batch.advantages.iter().map(|a| a / batch.steps().max(1) as f64).collect();
    climb(npg.step, actor, [&batch.input, &batch.actions], &weights, batch.steps())
}

/// Makes actions likelier by their weights, by a step of a size along the natural gradient. The divergence that it gives is the mean
/// over the first `own` of them.
pub(super) fn climb(
    step: f64,
    actor: &mut Actor,
    [input, taken]: [&[f32]; 2],
    weights: &[f64],
    own: usize,
) -> Update {
    let mut tape = Tape::default();
    actor.forward(input, &mut tape);
    let (old_means, old_log_std) = (tape.output().to_vec(), actor.parts().1.to_vec());
    let gradient = gradient(actor, &tape, taken, weights);
    let direction = solve(|v| fisher_product(actor, &tape, v), &gradient);
    let along = dot(&gradient, &direction);
    if along > 0.0 {
        let length = (step / along).sqrt();
        let moves = actor.parameters.iter_mut().zip(&direction);
        moves.for_each(|(parameter, move_)| *parameter += (length * move_) as f32);
        actor.limit();
    }
    let (observed, actions) = (actor.net.inputs(), actor.actions());
    Update {
        divergence: divergence(actor, [&old_means[..own * actions], &old_log_std], &input[..own * observed]),
        entropy: f64::from(gaussian::entropy(actor.parts().1)),
        clipped: 0.0,
        epochs: 1,
    }
}

/// The sum of the slopes of the logarithms of the densities of all actions by the parameters, each with its weight.
fn gradient(actor: &Actor, tape: &Tape, taken: &[f32], weights: &[f64]) -> Vec<f64> {
    let (actions, log_std) = (actor.actions(), actor.parts().1);
    let mut slopes = vec![0.0; taken.len()];
    let mut by_log_std = vec![0.0; actions];
    let taken = taken.chunks_exact(actions).zip(tape.output().chunks_exact(actions));
    for (((action, mean), by_mean), weight) in taken.zip(slopes.chunks_exact_mut(actions)).zip(weights) {
        gaussian::add_slopes(*weight as f32, [mean, log_std], action, [by_mean, &mut by_log_std]);
    }
    let mut gradient = vec![0.0; actor.net.parameters()];
    actor.net.backward(actor.parts().0, tape, &slopes, &mut gradient);
    gradient.iter().chain(&by_log_std).map(|slope| f64::from(*slope)).collect()
}

/// The product of the damped Fisher matrix, the mean over the rows of the tape, with a vector.
///
/// The matrix is `Jᵀ Σ⁻¹ J` in the parameters of the network, `J` being the Jacobian of the means, and 2 in the logarithms of the deviations.
fn fisher_product(actor: &Actor, tape: &Tape, vector: &[f64]) -> Vec<f64> {
    let (parameters, log_std) = actor.parts();
    let (by_net, by_log_std) = vector.split_at(parameters.len());
    let narrow: Vec<f32> = by_net.iter().map(|value| *value as f32).collect();
    let mut changes = actor.net.tangent(parameters, &narrow, tape);
    let scales: Vec<f32> =
        log_std.iter().map(|log_std| crate::nets::exp(-2.0 * log_std) / tape.rows() as f32).collect();
    for row in changes.chunks_exact_mut(scales.len()) {
        row.iter_mut().zip(&scales).for_each(|(change, scale)| *change *= scale);
    }
    let mut product = vec![0.0; parameters.len()];
    actor.net.backward(parameters, tape, &changes, &mut product);
    let product =
        product.iter().map(|value| f64::from(*value)).chain(by_log_std.iter().map(|value| 2.0 * value));
    product.zip(vector).map(|(product, value)| product + DAMPING * value).collect()
}

/// Solves a symmetric, positive system by conjugate gradients from zero.
fn solve(product: impl Fn(&[f64]) -> Vec<f64>, wanted: &[f64]) -> Vec<f64> {
    let mut solution = vec![0.0; wanted.len()];
    let (mut residual, mut direction) = (wanted.to_vec(), wanted.to_vec());
    let mut square = dot(&residual, &residual);
    for _ in 0..STEPS {
        if square < RESIDUAL {
            break;
        }
        let image = product(&direction);
        let length = square / dot(&direction, &image);
        for k in 0..solution.len() {
            solution[k] += length * direction[k];
            residual[k] -= length * image[k];
        }
        let next = dot(&residual, &residual);
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + next / square * *d);
        square = next;
    }
    solution
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::super::actor::Head;
    use super::*;
    use crate::nets::Activation;
    use random::Generator;

    const STEPS_TAKEN: usize = 600;

    /// A policy and a batch of drawn steps.
    fn example() -> (Actor, Batch, Tape) {
        let mut rng = Generator::pcg64(11_u64);
        let head = Head::Gaussian { log_std: -0.5, least: f32::NEG_INFINITY };
        let mut actor = Actor::new([3, 2], &[8, 8], Activation::Tanh, head, &mut rng);
        actor.parameters.iter_mut().take(actor.net.parameters()).for_each(|parameter| *parameter += 0.1);
        let mut numbers =
            |len: usize| -> Vec<f32> { (0..len).map(|_| rng.random() as f32 * 2.0 - 1.0).collect() };
        let (input, actions, advantages) =
            (numbers(3 * STEPS_TAKEN), numbers(2 * STEPS_TAKEN), numbers(STEPS_TAKEN));
        let advantages = advantages.iter().map(|value| f64::from(*value)).collect();
        let mut tape = Tape::default();
        actor.forward(&input, &mut tape);
        (actor, Batch { input, actions, advantages, returns: vec![0.0; STEPS_TAKEN] }, tape)
    }

    #[test]
    fn the_fisher_matrix_is_the_curvature_of_the_divergence() {
        let (actor, batch, tape) = example();
        let direction: Vec<f64> =
            (0..actor.parameters.len()).map(|k| ((k * 29) % 17) as f64 / 40.0 - 0.2).collect();
        let curvature = dot(&direction, &fisher_product(&actor, &tape, &direction));
        let old = [tape.output(), actor.parts().1];
        let moved = |share: f64| {
            let mut other = actor.clone();
            let moves = other.parameters.iter_mut().zip(&direction);
            moves.for_each(|(parameter, move_)| *parameter += (share * move_) as f32);
            divergence(&other, old, &batch.input)
        };
        let difference = (moved(0.05) + moved(-0.05)) / 0.0025;
        assert!(
            (difference - curvature).abs() < 0.02 * curvature && curvature > 0.1,
            "{difference} {curvature}"
        );
    }

    #[test]
    fn a_step_diverges_by_half_of_its_size() {
        let (mut actor, batch, _) = example();
        let outcome = update(&Npg { step: 1e-4 }, &mut actor, &batch);
        assert!((outcome.divergence - 5e-5).abs() < 5e-6, "{outcome:?}");
    }

    #[test]
    fn conjugate_gradients_solve_small_systems() {
        let matrix = [[4.0, 1.0, 0.0], [1.0, 3.0, -1.0], [0.0, -1.0, 2.0]];
        let product = |v: &[f64]| matrix.iter().map(|row| dot(row, v)).collect();
        let solution = solve(product, &[1.0, 2.0, 3.0]);
        let image: Vec<f64> = product(&solution);
        assert!(image.iter().zip([1.0, 2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{image:?}");
    }
}
