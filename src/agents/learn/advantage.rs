//! Returns and advantages of episodes (Schulman et al., 2016, equation 16).

use super::rollout::Episode;
use serde::{Deserialize, Serialize};

/// How far rewards count.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Horizon {
    /// Discount of a step.
    pub gamma: f64,
    /// Share of the advantage of the next step in that of a step: 0 trusts the value function, 1 the rewards.
    pub lambda: f64,
}

/// Advantages of the steps of an episode, and the returns that the value function is to learn: their sum with its values.
///
/// `values` are those of all observations. What an episode would have brought after its length was over is the value of its last
/// observation, and nothing where the task ended it.
///
/// # Panics
/// There are not as many values as observations.
pub fn advantages(horizon: Horizon, episode: &Episode, values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let steps = episode.rewards.len();
    assert_eq!(values.len(), steps + 1, "a value for each observation");
    let mut advantages = vec![0.0; steps];
    let (mut ahead, mut next) = (0.0, if episode.terminated { 0.0 } else { values[steps] });
    for k in (0..steps).rev() {
        let surprise = episode.rewards[k] + horizon.gamma * next - values[k];
        ahead = surprise + horizon.gamma * horizon.lambda * ahead;
        (advantages[k], next) = (ahead, values[k]);
    }
    let returns = advantages.iter().zip(values).map(|(advantage, value)| advantage + value).collect();
    (advantages, returns)
}

/// Shifts and scales numbers to mean 0 and deviation 1.
pub fn standardize(numbers: &mut [f64]) {
    let count = numbers.len().max(1) as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    let variance = numbers.iter().map(|number| (number - mean) * (number - mean)).sum::<f64>() / count;
    let scale = 1.0 / (variance.sqrt() + 1e-8);
    numbers.iter_mut().for_each(|number| *number = (*number - mean) * scale);
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::episode::Summary;

    fn episode(rewards: &[f64], terminated: bool) -> Episode {
        let (observations, actions) = (vec![0.0; rewards.len() + 1], vec![0.0; rewards.len()]);
        Episode {
            observations,
            actions,
            shown: Vec::new(),
            rewards: rewards.to_vec(),
            terminated,
            summary: Summary::default(),
        }
    }

    #[test]
    fn without_trust_in_values_returns_are_sums_of_rewards() {
        let (rewards, values) = ([1.0, 2.0, 4.0], [10.0, 20.0, 30.0, 40.0]);
        let horizon = Horizon { gamma: 0.5, lambda: 1.0 };
        let (advantages_, returns) = advantages(horizon, &episode(&rewards, true), &values);
        assert_eq!(returns, [3.0, 4.0, 4.0]);
        assert_eq!(advantages_, [-7.0, -16.0, -26.0]);
        let (_, returns) = advantages(horizon, &episode(&rewards, false), &values);
        assert_eq!(returns, [8.0, 14.0, 24.0], "the value of the last observation goes on");
    }

    #[test]
    fn with_all_trust_advantages_are_surprises_of_a_step() {
        let (rewards, values) = ([1.0, 2.0], [10.0, 20.0, 30.0]);
        let horizon = Horizon { gamma: 0.9, lambda: 0.0 };
        let (advantages, returns) = advantages(horizon, &episode(&rewards, false), &values);
        assert_eq!((advantages, returns), (vec![9.0, 9.0], vec![19.0, 29.0]));
    }

    #[test]
    fn standardized_numbers_have_deviation_one() {
        let mut numbers = [1.0, 2.0, 6.0];
        standardize(&mut numbers);
        assert!(numbers.iter().sum::<f64>().abs() < 1e-12);
        assert!((numbers.iter().map(|x| x * x).sum::<f64>() - 3.0).abs() < 1e-6 && numbers[2] > 1.3);
    }
}
