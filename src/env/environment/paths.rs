//! Rewards of recorded paths, from their observations alone.

use super::env::Env;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::Verdict;

/// The reward of one state of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathReward {
    /// The weighted sum of the terms.
    pub dense: f64,
    /// What the reward decides beside them.
    pub verdict: Verdict,
}

impl Env {
    /// Recomputes the rewards of a path from its observation vectors (T x length), as `compute_path_rewards` of the
    /// original does: the reward of a step belongs to the observation after it, so the first is that of the second
    /// observation, and the last observation's is repeated.
    ///
    /// # Errors
    /// The reward of this task needs more than observations; they have another length; or the reward needs rows that are
    /// not part of the observation.
    pub fn path_rewards(&self, observations: &[f64]) -> Result<Vec<PathReward>, EnvError> {
        if !self.task.rewards_paths() {
            return Err(self
                .spec()
                .wrong("rewards of this task need the simulation, not the observation alone"));
        }
        let width = self.observation().len();
        if width == 0 || !observations.len().is_multiple_of(width) {
            let message =
                format!("a path holds {} numbers, which is no multiple of {width}", observations.len());
            return Err(EnvError::ForeignState { message });
        }
        let mut rows = self.rows().clone();
        let mut terms = self.terms().clone();
        let rewards: Result<Vec<_>, _> = observations
            .chunks_exact(width)
            .map(|observation| self.observed_reward(observation, &mut rows, &mut terms))
            .collect();
        let mut rewards = rewards?;
        if let Some(last) = rewards.last().cloned() {
            rewards.rotate_left(1);
            *rewards.last_mut().expect("there is one") = last;
        }
        Ok(rewards)
    }

    /// The reward of one observation. Rows that are not part of it are NaN, so that a reward that needs them shows.
    fn observed_reward(
        &self,
        observation: &[f64],
        rows: &mut Rows,
        terms: &mut Rows,
    ) -> Result<PathReward, EnvError> {
        let mut values = vec![f64::NAN; rows.values().len()];
        let mut rest = observation;
        for place in &self.obs_places {
            let (row, after) = rest.split_at(place.len());
            values[place.clone()].copy_from_slice(row);
            rest = after;
        }
        rows.assign(&values);
        terms.begin();
        let verdict = self.task.reward(&self.view(), rows, terms);
        if let Some((row, _)) = terms.iter().find(|(_, term)| term[0].is_nan()) {
            let message =
                format!("the term {} needs rows that are not part of the observation vector", row.name());
            return Err(self.spec().wrong(message));
        }
        Ok(PathReward { dense: self.weighted(terms), verdict })
    }
}
