//! Environments: actions, observations, rewards.

use crate::simulation::{Simulation, exception};
use agents::Policy;
use env::{Env, Options, OwnModels};
use viewer::{Acting, Play, Session};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// What a step of an environment yields.
#[wasm_bindgen]
pub struct Step {
    /// The reward.
    pub reward: f64,
    /// The task ended the episode.
    pub terminated: bool,
    /// Its length, or a fault, ended it.
    pub truncated: bool,
}

#[wasm_bindgen]
impl Simulation {
    /// An environment on a model of our own, at the start of the episode of `seed`, acted in at random. With the bytes of a
    /// policy, one that `robohive train` wrote or one made for RoboHive (a pickle, which is not executed), the policy acts.
    ///
    /// # Errors
    /// There is no environment of that id, or the policy is not one that is understood.
    pub fn environment(id: &str, seed: u64, policy: Option<Vec<u8>>) -> Result<Simulation, JsError> {
        let env = Env::make(id, &OwnModels, &Options::default()).map_err(exception)?;
        let policy = policy.map(|bytes| Policy::parse(&bytes)).transpose().map_err(exception)?;
        let play = Play::new(env, policy, seed).map_err(exception)?;
        let warnings = play.env().warnings().to_string();
        Simulation::of(Session::playing(play), warnings).map_err(exception)
    }

    /// Starts the episode of a seed and returns its first observation.
    ///
    /// # Errors
    /// This is no environment.
    #[wasm_bindgen(js_name = resetTo)]
    pub fn reset_to(&mut self, seed: u64) -> Result<Vec<f64>, JsError> {
        self.playing()?;
        self.session.begin(seed);
        self.observation()
    }

    /// Takes an action for one control period.
    ///
    /// # Errors
    /// This is no environment; the action has another length or holds NaN; the episode is over.
    pub fn act(&mut self, action: &[f64]) -> Result<Step, JsError> {
        let play = self.playing()?;
        if play.is_over() {
            return Err(exception("the episode is over: call resetTo(seed)"));
        }
        let length = play.env().action_len();
        if action.len() != length || action.iter().any(|value| !value.is_finite()) {
            return Err(exception(format!("an action has {length} finite numbers, not {action:?}")));
        }
        if let Some(play) = self.session.play_mut() {
            play.let_act(Acting::Hand);
            play.hand().copy_from_slice(action);
        }
        self.step(1);
        if let Some(fault) = self.session.fault() {
            return Err(exception(fault));
        }
        let play = self.playing()?;
        let episode = play.episode();
        Ok(Step { reward: play.env().reward(), terminated: episode.terminated, truncated: episode.truncated })
    }

    /// What is observed.
    ///
    /// # Errors
    /// This is no environment.
    pub fn observation(&self) -> Result<Vec<f64>, JsError> {
        Ok(self.playing()?.env().observation().to_vec())
    }

    /// Lowest and highest value of each part of the action, one pair after the other.
    ///
    /// # Errors
    /// This is no environment.
    #[wasm_bindgen(js_name = actionBounds)]
    pub fn action_bounds(&self) -> Result<Vec<f64>, JsError> {
        let env = self.playing()?.env();
        Ok((0..env.action_len()).flat_map(|k| env.action_bounds(k)).collect())
    }

    /// Whether this is an environment.
    #[wasm_bindgen(getter, js_name = isEnvironment)]
    pub fn is_environment(&self) -> bool {
        self.session.play().is_some()
    }

    /// Sum of the rewards of the episode.
    ///
    /// # Errors
    /// This is no environment.
    #[wasm_bindgen(js_name = episodeReturn)]
    pub fn episode_return(&self) -> Result<f64, JsError> {
        Ok(self.playing()?.episode().reward)
    }

    /// Whether the task is solved now.
    ///
    /// # Errors
    /// This is no environment.
    pub fn solved(&self) -> Result<bool, JsError> {
        Ok(self.playing()?.env().verdict().solved)
    }

    fn playing(&self) -> Result<&Play, JsError> {
        self.session.play().ok_or_else(|| exception("this is a model, not an environment"))
    }
}
