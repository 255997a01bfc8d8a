//! What an environment tells of itself: its current state, and how it is set.

use super::env::Env;
use super::parts::action_bounds;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::pictures::visual::VisualKey;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::{RewardMode, Settings, Spec};
use crate::task::{Success, Verdict};
use crate::team::Team;
use mjcf::diagnostic::Diagnostics;
use robot::Robot;

impl Env {
    /// The reward of the current state, dense or sparse as the environment is set.
    pub fn reward(&self) -> f64 {
        match self.settings.reward_mode {
            RewardMode::Dense => self.dense,
            RewardMode::Sparse => self.verdict.sparse,
        }
    }

    /// The observation vector of the current state.
    pub fn observation(&self) -> &[f64] {
        &self.observation
    }

    /// The observation dictionary of the current state.
    pub fn rows(&self) -> &Rows {
        &self.rows
    }

    /// The terms of the reward of the current state, before their weights.
    pub fn terms(&self) -> &Rows {
        &self.terms
    }

    /// The weighted sum of the terms.
    pub fn dense(&self) -> f64 {
        self.dense
    }

    /// What the reward decides beside its terms.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// The proprioception of the current state: its rows one after the other. `None` where the task has none.
    pub fn proprioception(&self) -> Option<Vec<f64>> {
        self.proprio_keys()?;
        Some(
            self.proprio_places
                .iter()
                .flat_map(|place| &self.rows.values()[place.clone()])
                .copied()
                .collect(),
        )
    }

    /// Images of the exteroception.
    pub fn visual_keys(&self) -> &[VisualKey] {
        &self.visual_keys
    }

    /// What the id stands for.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// What was ignored or assumed when the model was read: how it is read otherwise than the MuJoCo that it was written for
    /// did.
    pub fn warnings(&self) -> &Diagnostics {
        &self.warnings
    }

    /// The settings of the environment.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Rows of the observation vector, in order; a row may be there twice.
    pub fn obs_keys(&self) -> &[String] {
        self.settings.obs_keys.as_deref().unwrap_or(&self.defaults.obs_keys)
    }

    /// Rows of the proprioception.
    pub fn proprio_keys(&self) -> Option<&[String]> {
        self.settings.proprio_keys.as_deref().or(self.defaults.proprio_keys.as_deref())
    }

    /// Terms of the dense reward with their weights.
    pub fn weights(&self) -> &[(String, f64)] {
        &self.weights
    }

    /// Rows of the observation that never change.
    pub fn constant_rows(&self) -> Vec<String> {
        self.task.constant_rows()
    }

    /// Rows of the observation that random actions may leave as they are.
    pub fn resting_rows(&self) -> Vec<String> {
        self.task.resting_rows()
    }

    /// The agents of an environment for several.
    pub fn team(&self) -> Option<&Team> {
        self.task.team()
    }

    /// When an episode counts as a success.
    pub fn success(&self) -> Success {
        self.defaults.success
    }

    /// The world.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The number of values in an action.
    pub fn action_len(&self) -> usize {
        self.action.len()
    }

    /// Lowest and highest value of component `k` of an action.
    pub fn action_bounds(&self, k: usize) -> [f64; 2] {
        action_bounds(&self.scene, self.settings.normalize_act, k)
    }

    /// Draws an action, every component uniform within its bounds.
    ///
    /// # Errors
    /// Bounds that are not finite.
    pub fn random_action(&self, rng: &mut Rng, action: &mut [f64]) -> Result<(), EnvError> {
        for (k, value) in action.iter_mut().enumerate() {
            let [low, high] = self.action_bounds(k);
            *value = rng.uniform(low, high)?;
        }
        Ok(())
    }

    /// Control period \[s\].
    pub fn dt(&self) -> f64 {
        self.scene.model.opt.timestep * self.frame_skip as f64
    }

    /// Time steps of the physics in one step of the environment.
    pub fn frame_skip(&self) -> usize {
        self.frame_skip
    }

    /// Steps taken in this episode.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Steps that physics refused since the environment was made.
    pub fn faults(&self) -> usize {
        self.faults
    }
}
