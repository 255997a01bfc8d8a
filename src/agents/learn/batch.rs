//! The steps of episodes as one batch: what a policy and a value function learn from.

use super::actor::Actor;
use super::advantage::{Horizon, advantages, standardize};
use super::critic::Critic;
use super::rollout::Episode;

/// Steps of all episodes, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// Normalised observations, `[steps × observed]`.
    pub input: Vec<f32>,
    /// Actions, `[steps × actions]`.
    pub actions: Vec<f32>,
    /// Advantages, of mean 0 and deviation 1 over the batch.
    pub advantages: Vec<f64>,
    /// What the value function is to learn.
    pub returns: Vec<f64>,
}

impl Batch {
    /// The batch of these episodes, as the policy normalises and the value function judges them now.
    pub fn new(episodes: &[Episode], actor: &Actor, critic: &Critic, horizon: Horizon) -> Self {
        let mut batch = Batch::default();
        for episode in episodes {
            let input = actor.normalized(&episode.observations);
            let (advantages, returns) = advantages(horizon, episode, &critic.values(&input));
            batch.input.extend_from_slice(&input[..input.len() - actor.seen.width()]);
            batch.actions.extend_from_slice(&episode.actions);
            batch.advantages.extend(advantages);
            batch.returns.extend(returns);
        }
        standardize(&mut batch.advantages);
        batch
    }

    /// Number of steps.
    pub fn steps(&self) -> usize {
        self.returns.len()
    }
}
