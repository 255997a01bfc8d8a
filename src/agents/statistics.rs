//! What results of few runs are worth: means that outliers do not decide, and intervals.
//!
//! ```
//! use robohive_agents::statistics::{bootstrap, interquartile_mean, wilson};
//!
//! // Runs of two tasks, by their success [%].
//! let tasks = [vec![90.0, 95.0, 100.0, 20.0], vec![50.0, 60.0, 55.0, 58.0]];
//! assert_eq!(interquartile_mean(&tasks.concat()), 65.75);
//! let [low, high] = bootstrap(&tasks, interquartile_mean, 1);
//! assert!(low > 40.0 && low < 65.75 && high > 65.75 && high < 80.0);
//! // 10 of 10 episodes are no proof of 100 %.
//! assert!((wilson(1.0, 10)[0] - 0.722).abs() < 1e-3);
//! ```

use random::{Generator, SeedSequence};

/// Quantile of the normal distribution for 95 % on both sides.
const QUANTILE: f64 = 1.959_963_984_540_054;
/// Samples of a bootstrap.
const SAMPLES: usize = 2000;

/// The mean of the middle half: a quarter of the numbers, rounded down, is left out at either end (Agarwal et al., 2021, section 4.3). NaN
/// without numbers.
pub fn interquartile_mean(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let cut = sorted.len() / 4;
    let middle = &sorted[cut..sorted.len() - cut];
    middle.iter().sum::<f64>() / middle.len() as f64
}

/// The 95 % interval of a statistic of all runs: percentiles of a bootstrap that draws as many runs of each task as there are (Agarwal et al.,
/// 2021, section 4.1). A task with one run has no spread of its own. The seed decides what is drawn.
pub fn bootstrap(tasks: &[Vec<f64>], statistic: impl Fn(&[f64]) -> f64, seed: u64) -> [f64; 2] {
    let mut rng = Generator::pcg64(SeedSequence::new(seed));
    let mut drawn = Vec::new();
    let mut values: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            drawn.clear();
            for runs in tasks {
                drawn.extend(runs.iter().map(|_| runs[(rng.random() * runs.len() as f64) as usize]));
            }
            statistic(&drawn)
        })
        .collect();
    values.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| values[(share * (SAMPLES - 1) as f64).round() as usize])
}

/// The 95 % interval of a share of `count` trials (Wilson, 1927).
pub fn wilson(share: f64, count: u32) -> [f64; 2] {
    let (count, square) = (f64::from(count), QUANTILE * QUANTILE);
    let middle = (share + square / (2.0 * count)) / (1.0 + square / count);
    let half = QUANTILE / (1.0 + square / count)
        * (share * (1.0 - share) / count + square / (4.0 * count * count)).sqrt();
    [(middle - half).max(0.0), (middle + half).min(1.0)]
}

/// The share of the runs whose score is above each threshold: a performance profile (Agarwal et al., 2021, section 4.2).
pub fn profile(scores: &[f64], thresholds: &[f64]) -> Vec<f64> {
    let above = |threshold: &f64| scores.iter().filter(|score| *score > threshold).count();
    thresholds.iter().map(|threshold| above(threshold) as f64 / scores.len() as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `scipy.stats.trim_mean(scores, 0.25)`.
    #[test]
    fn the_middle_half_is_what_scipy_trims_to() {
        assert_eq!(interquartile_mean(&[1.0, 2.0, 30.0]), 11.0);
        assert_eq!(interquartile_mean(&[100.0, 2.0, 4.0, 1.0]), 3.0);
        assert_eq!(interquartile_mean(&[9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]), 5.0);
    }

    /// The mean of n numbers of deviation s is spread by s / √n.
    #[test]
    fn a_bootstrap_is_as_wide_as_theory_says() {
        let runs: Vec<f64> = (0..100).map(f64::from).collect();
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len() as f64;
        let [low, high] = bootstrap(&[runs], mean, 3);
        let expected = 2.0 * QUANTILE * (9999.0_f64 / 12.0 / 100.0).sqrt();
        assert!(((high - low) - expected).abs() < 0.1 * expected, "{low} {high}");
        assert!((0.5 * (low + high) - 49.5).abs() < 1.0);
        let apart = bootstrap(&[vec![1.0], vec![100.0]], mean, 3);
        assert_eq!(apart, [50.5, 50.5], "runs are not drawn for another task");
    }

    /// Brown, Cai and DasGupta (2001), section 3.1.1, give the formula; its ends for 0 and for all are n/(n + z²) and its complement.
    #[test]
    fn intervals_hold_the_share_and_are_not_empty_at_the_ends() {
        let [low, high] = wilson(0.0, 20);
        assert!(low == 0.0 && (high - 3.841_458_820_694_124 / 23.841_458_820_694_124).abs() < 1e-11);
        let [low, high] = wilson(1.0, 200);
        assert!((low - 200.0 / 203.841_458_820_694_124).abs() < 1e-11 && high > 0.999_99);
        let [low, high] = wilson(0.5, 100);
        assert!((low + high - 1.0).abs() < 1e-11 && (low - 0.4038).abs() < 1e-4, "{low} {high}");
    }

    #[test]
    fn a_profile_falls_from_all_to_none() {
        assert_eq!(profile(&[10.0, 50.0, 90.0, 90.0], &[0.0, 10.0, 60.0, 90.0]), [1.0, 0.75, 0.5, 0.0]);
    }
}
