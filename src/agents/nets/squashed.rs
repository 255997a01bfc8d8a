//! Gaussian distributions of actions squashed into (-1, 1) by the hyperbolic tangent (Haarnoja et al., 2018, appendix C).
//!
//! A network gives two numbers for each action, first all means and then all that decide deviations: the mean and the logarithm of the
//! deviation of the Gaussian whose hyperbolic tangent the action is.
//!
//! ```
//! use robohive_agents::nets::Squashed;
//!
//! let head = Squashed { first: -1.0, least: -4.0 };
//! let mut action = [0.0];
//! // Noise of one deviation, which is e⁻¹ where the network gives 0.
//! let log_density = head.act(&[0.5, 0.0], &[1.0], &mut action);
//! assert!((action[0] - (0.5 + (-1.0_f32).exp()).tanh()).abs() < 1e-6 && log_density < 1.0);
//! ```

use super::activation::{exp, tanh};
use super::gaussian::{self, LN_TAU};

/// How deviations follow from what a network gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Squashed {
    /// Logarithm of a deviation where the network gives 0.
    pub first: f32,
    /// The least logarithm; the greatest is as far above the first.
    pub least: f32,
}

impl Squashed {
    /// The logarithm of the deviation for a number of the network, and its slope by that.
    fn log_std(&self, raw: f32) -> [f32; 2] {
        let (bent, reach) = (tanh(raw), self.first - self.least);
        [self.first + reach * bent, reach * (1.0 - bent * bent)]
    }

    /// Computes the action for a standard normal noise, and gives the logarithm of its density.
    ///
    /// # Panics
    /// There are not twice as many outputs, or as many numbers of noise, as actions.
    pub fn act(&self, outputs: &[f32], noise: &[f32], action: &mut [f32]) -> f32 {
        let (means, raw) = halves(outputs, action.len());
        let mut log_density = 0.0;
        for (k, action) in action.iter_mut().enumerate() {
            let [log_std, _] = self.log_std(raw[k]);
            let before = means[k] + exp(log_std) * noise[k];
            *action = tanh(before);
            log_density -= 0.5 * (noise[k] * noise[k] + LN_TAU) + log_std + log_slope(before);
        }
        log_density
    }

    /// The action of the mean, which is the median of the actions.
    ///
    /// # Panics
    /// There are not twice as many outputs as actions.
    pub fn median(&self, outputs: &[f32], action: &mut [f32]) {
        let (means, _) = halves(outputs, action.len());
        action.iter_mut().zip(means).for_each(|(action, mean)| *action = tanh(*mean));
    }

    /// Writes the slopes, by the outputs, of `weight` times the logarithm of the density plus a function of the action with these
    /// slopes, both at the action that [`Squashed::act`] made of the noise.
    ///
    /// # Panics
    /// Lengths do not fit.
    pub fn slopes(
        &self,
        outputs: &[f32],
        [noise, action]: [&[f32]; 2],
        weight: f32,
        by_action: &[f32],
        by_outputs: &mut [f32],
    ) {
        let (_, raw) = halves(outputs, action.len());
        let (by_means, by_raw) = by_outputs.split_at_mut(action.len());
        for k in 0..action.len() {
            let [log_std, slope] = self.log_std(raw[k]);
            let before = by_action[k] * (1.0 - action[k] * action[k]) + weight * 2.0 * action[k];
            by_means[k] = before;
            by_raw[k] = slope * (before * exp(log_std) * noise[k] - weight);
        }
    }

    /// The divergence of the distribution of one row of outputs from that of another, which squashing leaves as it is.
    pub fn divergence(&self, one: &[f32], other: &[f32]) -> f32 {
        let actions = one.len() / 2;
        let logs = [one, other]
            .map(|row| -> Vec<f32> { row[actions..].iter().map(|raw| self.log_std(*raw)[0]).collect() });
        gaussian::divergence([&one[..actions], &logs[0]], [&other[..actions], &logs[1]])
    }
}

/// Means, and what decides deviations.
fn halves(outputs: &[f32], actions: usize) -> (&[f32], &[f32]) {
    assert_eq!(outputs.len(), 2 * actions, "two outputs for each action");
    outputs.split_at(actions)
}

/// The logarithm of the slope of the hyperbolic tangent, without the loss of digits of `ln(1 - tanh²)`.
fn log_slope(x: f32) -> f32 {
    let far = x.abs();
    2.0 * (std::f32::consts::LN_2 - far - libm::log1pf(exp(-2.0 * far)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use random::Generator;

    const HEAD: Squashed = Squashed { first: -0.7, least: -3.0 };
    const OUTPUTS: [f32; 4] = [0.4, -1.1, 0.2, -0.5];
    const NOISE: [f32; 2] = [0.8, -1.3];

    #[test]
    fn slopes_are_differences() {
        let (weight, by_action) = (0.6, [1.5, -0.8]);
        let value = |outputs: &[f32; 4]| {
            let mut action = [0.0; 2];
            let log_density = HEAD.act(outputs, &NOISE, &mut action);
            weight * log_density + by_action[0] * action[0] + by_action[1] * action[1]
        };
        let (mut action, mut slopes, step) = ([0.0; 2], [0.0; 4], 1e-2);
        HEAD.act(&OUTPUTS, &NOISE, &mut action);
        HEAD.slopes(&OUTPUTS, [&NOISE, &action], weight, &by_action, &mut slopes);
        for k in 0..4 {
            let [mut above, mut below] = [OUTPUTS; 2];
            above[k] += step;
            below[k] -= step;
            let expected = (value(&above) - value(&below)) / (2.0 * step);
            assert!(
                (slopes[k] - expected).abs() < 2e-3 * expected.abs().max(1.0),
                "{k}: {slopes:?} {expected}"
            );
        }
    }

    #[test]
    fn densities_add_up_to_one() {
        // The density of an action is that of the noise which makes it: it is integrated over the actions of small steps of noise.
        let (mut sum, mut last, step) = (0.0, -1.0_f64, 1e-3);
        for k in -6000..6000 {
            let (mut action, noise) = ([0.0], [(f64::from(k) * step) as f32]);
            let log_density = HEAD.act(&[0.3, 0.1], &noise, &mut action);
            sum += f64::from(log_density).exp() * (f64::from(action[0]) - last);
            last = f64::from(action[0]);
        }
        assert!((sum - 1.0).abs() < 2e-3, "{sum}");
    }

    #[test]
    fn divergence_is_a_mean_over_draws_of_squashed_actions() {
        let (one, other) = ([0.4, 0.2], [0.1, -0.1]);
        let ([log_one, _], [log_other, _]) = (HEAD.log_std(one[1]), HEAD.log_std(other[1]));
        let (mut rng, mut gain) = (Generator::pcg64(4_u64), 0.0);
        const DRAWS: usize = 40_000;
        for _ in 0..DRAWS {
            let noise = rng.standard_normal() as f32;
            // The noise by which the other makes the same action.
            let theirs = (one[0] + exp(log_one) * noise - other[0]) * exp(-log_other);
            let mut action = [0.0];
            let ours = HEAD.act(&one, &[noise], &mut action);
            gain += f64::from(ours - HEAD.act(&other, &[theirs], &mut action)) / DRAWS as f64;
        }
        let divergence = f64::from(HEAD.divergence(&one, &other));
        assert!((gain - divergence).abs() < 0.02 && divergence > 0.1, "{gain} {divergence}");
    }

    #[test]
    fn far_outputs_stay_finite() {
        let mut action = [0.0];
        for mean in [-60.0, 60.0] {
            let log_density = HEAD.act(&[mean, 50.0], &[0.0], &mut action);
            assert!(log_density.is_finite() && action[0].abs() == 1.0, "{log_density} {action:?}");
        }
    }
}
