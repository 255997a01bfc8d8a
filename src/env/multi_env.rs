//! An environment of several agents, agent by agent.

use crate::assets::Assets;
use crate::environment::{Env, Options, Step};
use crate::error::EnvError;
use crate::registry::Registry;
use crate::rows::Row;
use crate::team::{Agent, Team};

/// An environment whose agents act at the same time: each has an action, an observation and a reward of its own.
///
/// ```
/// use robohive_env::{MultiEnv, Options, OwnModels};
///
/// let mut env = MultiEnv::make("hive/DKittyPairPushBox-v0", &OwnModels, &Options::default())?;
/// env.reset(Some(1))?;
/// assert_eq!(env.agents().collect::<Vec<_>>(), ["left", "right"]);
/// let still = [0.0; 12];
/// let steps = env.step(&[("right", &still), ("left", &still)])?;
/// assert_eq!(steps.len(), 2, "in the order of agents()");
/// assert_ne!(env.observation("left")?, env.observation("right")?);
/// let (row, _) = env.observation_rows("left")?[0].clone();
/// assert_eq!(row, "height", "an agent knows its rows without its name");
/// assert_eq!(
///     env.step(&[("left", &still)]).unwrap_err().to_string(),
///     "the agent right has no action; give each agent one",
/// );
/// # Ok::<(), robohive_env::EnvError>(())
/// ```
pub struct MultiEnv {
    env: Env,
    team: Team,
    action: Vec<f64>,
}

impl MultiEnv {
    /// Makes the environment of an id from the built-in registry, ready for [`MultiEnv::reset`].
    ///
    /// # Errors
    /// As [`Env::make`]; an id for one agent.
    pub fn make(id: &str, assets: &dyn Assets, options: &Options) -> Result<Self, EnvError> {
        Self::new(Env::make(id, assets, options)?)
    }

    /// An environment that was made, agent by agent.
    ///
    /// # Errors
    /// It is for one agent.
    pub fn new(env: Env) -> Result<Self, EnvError> {
        let Some(team) = env.team().cloned() else {
            let ids = Registry::builtin().specs().iter().filter(|spec| spec.suite == "multi_agent");
            let ids = ids.map(|spec| &*spec.id).collect::<Vec<_>>().join(", ");
            let message =
                format!("{} is an environment for one agent; for several there are {ids}", env.spec().id);
            return Err(EnvError::Agents { message });
        };
        let action = vec![0.0; env.action_len()];
        Ok(MultiEnv { env, team, action })
    }

    /// The joint view.
    pub fn env(&self) -> &Env {
        &self.env
    }

    /// The joint view, to draw it, or to save and restore its state.
    pub fn env_mut(&mut self) -> &mut Env {
        &mut self.env
    }

    /// What the agents command, observe and earn.
    pub fn team(&self) -> &Team {
        &self.team
    }

    /// Names of the agents, in order.
    pub fn agents(&self) -> impl ExactSizeIterator<Item = &str> {
        self.team.agents().iter().map(Agent::name)
    }

    /// Starts an episode. A seed restarts all draws first.
    ///
    /// # Errors
    /// As [`Env::reset`].
    pub fn reset(&mut self, seed: Option<u64>) -> Result<(), EnvError> {
        self.env.reset(seed).map(|_| ())
    }

    /// Applies one action for each agent, named and in any order, for one control period. Returns what the step yields for each
    /// agent, in the order of [`MultiEnv::agents`]. An episode ends for all agents at once.
    ///
    /// # Errors
    /// Actions that do not fit the agents ([`Team::join`]); otherwise as [`Env::step`].
    pub fn step(&mut self, actions: &[(&str, &[f64])]) -> Result<Vec<Step>, EnvError> {
        self.team.join(actions, &mut self.action)?;
        let joint = self.env.step(&self.action)?;
        let refused = joint.fault.is_some();
        let reward = |agent: &Agent| if refused { 0.0 } else { agent.reward(self.env.terms()) };
        let each = self.team.agents().iter();
        Ok(each.map(|agent| Step { reward: reward(agent), ..joint.clone() }).collect())
    }

    /// What an agent observes of the present state: its rows one after the other, in their units.
    ///
    /// # Errors
    /// There is no such agent.
    pub fn observation(&self, agent: &str) -> Result<Vec<f64>, EnvError> {
        Ok(self.team.agent(agent)?.observation(self.env.rows()))
    }

    /// The rows of an agent's observation, in order: what it calls them, and what the environment has of them (name, unit, length).
    ///
    /// # Errors
    /// There is no such agent.
    pub fn observation_rows(&self, agent: &str) -> Result<Vec<(String, Row)>, EnvError> {
        let rows = self.env.rows().rows();
        let row = |named: &str| rows.iter().find(|row| row.name() == named).cloned();
        let observes = self.team.agent(agent)?.observes();
        Ok(observes.filter_map(|(name, named)| Some((name.to_owned(), row(named)?))).collect())
    }

    /// Number of values in an agent's action.
    ///
    /// # Errors
    /// There is no such agent.
    pub fn action_len(&self, agent: &str) -> Result<usize, EnvError> {
        Ok(self.team.agent(agent)?.commands().len())
    }

    /// Lowest and highest value of each component of an agent's action: -1 and 1, or units of the actuator where actions are not
    /// normalised.
    ///
    /// # Errors
    /// There is no such agent.
    pub fn action_bounds(&self, agent: &str) -> Result<Vec<[f64; 2]>, EnvError> {
        let commands = self.team.agent(agent)?.commands();
        Ok(commands.iter().map(|&k| self.env.action_bounds(k)).collect())
    }
}
