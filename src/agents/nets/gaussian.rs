//! Gaussian distributions of actions whose components are independent, given by means and logarithms of standard deviations.
//!
//! ```
//! use robohive_agents::nets::gaussian::{divergence, log_density};
//!
//! // The standard normal distribution at 0 is 1 / √(2π).
//! assert!((log_density(&[0.0], &[0.0], &[0.0]) + 0.918_938_5).abs() < 1e-6);
//! // One of the same width a deviation away diverges by 1 / 2.
//! assert_eq!(divergence([&[1.0], &[0.0]], [&[0.0], &[0.0]]), 0.5);
//! ```

use super::activation::exp;
use random::{BitGenerator, Generator};

/// The logarithm of 2π.
pub(super) const LN_TAU: f32 = 1.837_877_1;

/// Draws an action from a distribution.
pub fn draw(mean: &[f32], log_std: &[f32], rng: &mut Generator<impl BitGenerator>, action: &mut [f32]) {
    for ((action, mean), log_std) in action.iter_mut().zip(mean).zip(log_std) {
        *action = mean + exp(*log_std) * rng.standard_normal() as f32;
    }
}

/// The logarithm of the density of an action.
pub fn log_density(mean: &[f32], log_std: &[f32], action: &[f32]) -> f32 {
    let terms = action.iter().zip(mean).zip(log_std).map(|((action, mean), log_std)| {
        let z = (action - mean) * exp(-log_std);
        -0.5 * (z * z + LN_TAU) - log_std
    });
    terms.sum()
}

/// Adds `weight` times the slopes of [`log_density`] by the means and by the logarithms of the deviations.
pub fn add_slopes(
    weight: f32,
    [mean, log_std]: [&[f32]; 2],
    action: &[f32],
    [by_mean, by_log_std]: [&mut [f32]; 2],
) {
    for k in 0..action.len() {
        let scale = exp(-log_std[k]);
        let z = (action[k] - mean[k]) * scale;
        by_mean[k] += weight * z * scale;
        by_log_std[k] += weight * (z * z - 1.0);
    }
}

/// The entropy of a distribution.
pub fn entropy(log_std: &[f32]) -> f32 {
    log_std.iter().map(|log_std| log_std + 0.5 * (LN_TAU + 1.0)).sum()
}

/// The Kullback-Leibler divergence of a distribution from another, each a pair of means and logarithms of deviations.
pub fn divergence(one: [&[f32]; 2], other: [&[f32]; 2]) -> f32 {
    let terms = (0..one[0].len()).map(|k| {
        let (away, ratio) = ((one[0][k] - other[0][k]) * exp(-other[1][k]), exp(one[1][k] - other[1][k]));
        other[1][k] - one[1][k] + 0.5 * (ratio * ratio + away * away - 1.0)
    });
    terms.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MEAN: [f32; 2] = [0.3, -1.2];
    const LOG_STD: [f32; 2] = [-0.5, 0.4];

    #[test]
    fn slopes_are_differences_of_the_density() {
        let (action, step) = ([0.9, 0.1], 1e-2_f32);
        let (mut by_mean, mut by_log_std) = ([0.0; 2], [0.0; 2]);
        add_slopes(2.0, [&MEAN, &LOG_STD], &action, [&mut by_mean, &mut by_log_std]);
        for k in 0..2 {
            let moved = |numbers: [f32; 2], step: f32| {
                let mut numbers = numbers;
                numbers[k] += step;
                numbers
            };
            let mean = |step| log_density(&moved(MEAN, step), &LOG_STD, &action);
            let log_std = |step| log_density(&MEAN, &moved(LOG_STD, step), &action);
            assert!((by_mean[k] - (mean(step) - mean(-step)) / step).abs() < 2e-3, "{by_mean:?}");
            assert!((by_log_std[k] - (log_std(step) - log_std(-step)) / step).abs() < 2e-3, "{by_log_std:?}");
        }
    }

    #[test]
    fn entropy_and_divergence_are_means_over_draws() {
        let other = ([0.0_f32, -1.0], [-0.3_f32, 0.1]);
        let (mut rng, mut action) = (Generator::pcg64(3_u64), [0.0; 2]);
        let (mut surprise, mut gain) = (0.0, 0.0);
        const DRAWS: usize = 40_000;
        for _ in 0..DRAWS {
            draw(&MEAN, &LOG_STD, &mut rng, &mut action);
            let density = log_density(&MEAN, &LOG_STD, &action);
            surprise -= f64::from(density) / DRAWS as f64;
            gain += f64::from(density - log_density(&other.0, &other.1, &action)) / DRAWS as f64;
        }
        let divergence = f64::from(divergence([&MEAN, &LOG_STD], [&other.0, &other.1]));
        assert!((surprise - f64::from(entropy(&LOG_STD))).abs() < 0.02, "{surprise}");
        assert!((gain - divergence).abs() < 0.02 && divergence > 0.1, "{gain} {divergence}");
    }
}
