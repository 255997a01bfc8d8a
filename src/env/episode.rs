//! What episodes add up to: returns and success.
//!
//! ```
//! use robohive_env::episode::{Summary, evaluate};
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default())?;
//! env.reset(Some(1))?;
//! let (mut episode, action) = (Summary::default(), vec![0.0; env.action_len()]);
//! for _ in 0..4 {
//!     let step = env.step(&action)?;
//!     episode.add(&env, &step);
//! }
//! let evaluation = evaluate(&[episode.clone()], env.success());
//! assert_eq!((episode.steps, evaluation.reward), (4, episode.reward));
//! # Ok::<(), robohive_env::EnvError>(())
//! ```

use crate::environment::{Env, Step};
use crate::task::Success;

/// An episode, or the part of it seen so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Steps taken.
    pub steps: usize,
    /// Sum of the rewards that the steps returned.
    pub reward: f64,
    /// Sum of the dense rewards.
    pub dense: f64,
    /// Sum of the sparse rewards.
    pub sparse: f64,
    /// Steps that ended in a solved state.
    pub solved: usize,
    /// Whether the task ended it.
    pub terminated: bool,
    /// Whether its length or a fault ended it.
    pub truncated: bool,
    /// Whether physics refused its last step.
    pub faulty: bool,
}

impl Summary {
    /// Adds a step.
    pub fn add(&mut self, env: &Env, step: &Step) {
        self.steps += 1;
        self.reward += step.reward;
        self.terminated |= step.terminated;
        self.truncated |= step.truncated;
        self.faulty |= step.fault.is_some();
        if step.fault.is_none() {
            self.dense += env.dense();
            self.sparse += env.verdict().sparse;
            self.solved += usize::from(env.verdict().solved);
        }
    }

    /// How far the episode counts as a success, 0 to 1.
    pub fn success(&self, rule: Success) -> f64 {
        match rule {
            Success::MoreThan(steps) => f64::from(self.solved > steps),
            Success::Share => self.solved as f64 / self.steps.max(1) as f64,
        }
    }
}

/// What RoboHive logs of evaluated episodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evaluation {
    /// Share of successful episodes \[%\].
    pub success_percentage: f64,
    /// Mean sparse reward of a step.
    pub rwd_sparse: f64,
    /// Mean over episodes of the mean dense reward of their steps.
    pub rwd_dense: f64,
    /// Mean return.
    pub reward: f64,
}

/// Evaluates episodes as `evaluate_success` of the original does; zeros where there are none.
pub fn evaluate(episodes: &[Summary], rule: Success) -> Evaluation {
    let mean = |value: &dyn Fn(&Summary) -> f64| {
        episodes.iter().map(value).sum::<f64>() / episodes.len().max(1) as f64
    };
    let steps = |episode: &Summary| episode.steps.max(1) as f64;
    Evaluation {
        success_percentage: 100.0 * mean(&|episode| episode.success(rule)),
        rwd_sparse: mean(&|episode| episode.sparse / steps(episode)),
        rwd_dense: mean(&|episode| episode.dense / steps(episode)),
        reward: mean(&|episode| episode.reward),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_five_solved_steps_are_a_success() {
        let episode =
            |solved| Summary { steps: 50, solved, dense: 100.0, sparse: -25.0, ..Summary::default() };
        let rule = Success::MoreThan(5);
        let evaluation = evaluate(&[episode(5), episode(6), episode(0), episode(50)], rule);
        assert_eq!(evaluation.success_percentage, 50.0);
        assert_eq!((evaluation.rwd_dense, evaluation.rwd_sparse), (2.0, -0.5));
        assert_eq!(episode(10).success(Success::Share), 0.2);
        assert_eq!(evaluate(&[], rule), Evaluation::default());
    }
}
