//! Several agents in one environment: what each commands, observes and earns.
//!
//! A task for several agents names them in a [`Team`], which is all that tells it from others. Its environment is an ordinary
//! [`Env`](crate::Env), the joint view: the action has the controls of all agents in the order of the model, the observation
//! the rows of all, and the reward is the sum of what the agents earn where they share their success, and what the first of them
//! earns where they compete. [`MultiEnv`](crate::MultiEnv) is the same environment agent by agent.
//!
//! What belongs to an agent begins with its name and an underscore: elements of the model (`left_torso`), rows of the observation
//! (`left_height`), terms of the reward (`left_upright`). The agent itself knows its rows without that.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;

/// An agent.
#[derive(Clone, Debug, PartialEq)]
pub struct Agent {
    name: String,
    commands: Vec<usize>,
    observes: Vec<Seen>,
    earns: Vec<(String, f64)>,
}

/// A row that an agent observes.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Seen {
    /// As the agent calls it.
    name: String,
    /// As the environment calls it.
    row: String,
}

/// The agents of a task, in the order in which they stand in the joint view.
///
/// ```
/// use robohive_env::{Env, Options, OwnModels};
///
/// let env = Env::make("hive/DKittyPairPushBox-v0", &OwnModels, &Options::default())?;
/// let team = env.team().ok_or("a task for one")?;
/// let names: Vec<_> = team.agents().iter().map(|agent| agent.name()).collect();
/// assert_eq!(names, ["left", "right"]);
/// assert_eq!(team.agent("right")?.commands(), (12..24).collect::<Vec<_>>());
/// assert_eq!(team.agent("lft").unwrap_err().to_string(), "there is no agent lft; there are left, right");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Team {
    agents: Vec<Agent>,
    stakes: Stakes,
}

/// How rewards of agents make the reward of the joint view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stakes {
    /// The sum: the agents cooperate.
    Shared,
    /// What the first agent earns: the agents compete.
    Opposed,
}

/// What an agent of this name is called in a model and in rows: its name and an underscore.
pub fn prefix(agent: &str) -> String {
    format!("{agent}_")
}

impl Agent {
    /// The agent that commands all actuators whose names begin with its prefix. It observes rows of its `own` and rows that
    /// all agents `share`, in this order.
    ///
    /// # Errors
    /// The model has no actuator of the agent.
    pub fn new(name: &str, scene: &Scene, own: &[&str], shared: &[&str]) -> Result<Self, EnvError> {
        let (m, prefix) = (&scene.model, prefix(name));
        let actuators = m.actuator_names().filter(|(_, actuator)| actuator.starts_with(&prefix));
        let commands: Vec<usize> = actuators.map(|(id, _)| m.actuator_ctrladr[id.index()] as usize).collect();
        if commands.is_empty() {
            let message = format!(
                "the agent {name} commands nothing: no actuator of the model has a name that begins with {prefix}"
            );
            return Err(EnvError::Agents { message });
        }
        let own = own.iter().map(|row| Seen { name: (*row).into(), row: format!("{prefix}{row}") });
        let shared = shared.iter().map(|row| Seen { name: (*row).into(), row: (*row).into() });
        Ok(Agent { name: name.into(), commands, observes: own.chain(shared).collect(), earns: Vec::new() })
    }

    /// The agent with a reward: weights of terms of its own, and of terms that all agents share.
    #[must_use]
    pub fn earning(mut self, own: &[(&str, f64)], shared: &[(&str, f64)]) -> Self {
        let prefix = prefix(&self.name);
        let own = own.iter().map(|(term, weight)| (format!("{prefix}{term}"), *weight));
        let shared = shared.iter().map(|(term, weight)| ((*term).to_owned(), *weight));
        self.earns.extend(own.chain(shared));
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Components of the joint action that its action consists of, in order.
    pub fn commands(&self) -> &[usize] {
        &self.commands
    }

    /// Rows that it observes, in order: the name that it has for them, and that of the environment.
    pub fn observes(&self) -> impl ExactSizeIterator<Item = (&str, &str)> {
        self.observes.iter().map(|seen| (&*seen.name, &*seen.row))
    }

    /// Terms of its reward, by the environment's names, with their weights.
    pub fn earns(&self) -> &[(String, f64)] {
        &self.earns
    }

    /// What it observes, row after row, in the units of the rows.
    pub fn observation(&self, rows: &Rows) -> Vec<f64> {
        self.observes.iter().flat_map(|seen| &rows[&*seen.row]).copied().collect()
    }

    /// Its reward: the weighted sum of its terms.
    pub fn reward(&self, terms: &Rows) -> f64 {
        self.earns.iter().map(|(term, weight)| weight * terms[&**term][0]).sum()
    }
}

impl Team {
    /// Agents with these stakes.
    pub fn new(agents: Vec<Agent>, stakes: Stakes) -> Self {
        Team { agents, stakes }
    }

    /// The agents, in order.
    pub fn agents(&self) -> &[Agent] {
        &self.agents
    }

    /// Whether they cooperate.
    pub fn stakes(&self) -> Stakes {
        self.stakes
    }

    /// The agent of a name.
    ///
    /// # Errors
    /// There is none; the message lists those that there are.
    pub fn agent(&self, name: &str) -> Result<&Agent, EnvError> {
        Ok(&self.agents[self.place(name)?])
    }

    /// Rows of the joint observation: those of all agents, each once.
    pub fn obs_keys(&self) -> Vec<&str> {
        let mut keys: Vec<&str> = Vec::new();
        for (_, row) in self.agents.iter().flat_map(Agent::observes) {
            if !keys.contains(&row) {
                keys.push(row);
            }
        }
        keys
    }

    /// Terms of the joint reward with their weights.
    pub fn weights(&self) -> Vec<(&str, f64)> {
        let paid = match self.stakes {
            Stakes::Shared => &self.agents[..],
            Stakes::Opposed => &self.agents[..1],
        };
        let mut weights: Vec<(&str, f64)> = Vec::new();
        for (term, weight) in paid.iter().flat_map(Agent::earns) {
            match weights.iter_mut().find(|(known, _)| known == term) {
                Some((_, sum)) => *sum += weight,
                None => weights.push((term, *weight)),
            }
        }
        weights
    }

    /// Writes the joint action that consists of one action for each agent, in any order.
    ///
    /// # Errors
    /// An agent that does not exist, that has no action or two; an action of another length, or with a number that is not finite.
    pub fn join(&self, actions: &[(&str, &[f64])], joint: &mut [f64]) -> Result<(), EnvError> {
        let wrong = |message: String| Err(EnvError::Agents { message });
        for (k, (name, action)) in actions.iter().enumerate() {
            let agent = self.agent(name)?;
            if actions[..k].iter().any(|(other, _)| other == name) {
                return wrong(format!("the agent {name} has two actions; give each agent one"));
            }
            let (expected, found) = (agent.commands.len(), action.len());
            if expected != found {
                return wrong(format!(
                    "an action of the agent {name} has {expected} values, and {found} were given"
                ));
            }
            if let Some(index) = action.iter().position(|value| !value.is_finite()) {
                return wrong(format!(
                    "value {index} of the action of the agent {name} is {}; actions are finite numbers",
                    action[index]
                ));
            }
            for (place, value) in agent.commands.iter().zip(*action) {
                joint[*place] = *value;
            }
        }
        match self.agents.iter().find(|agent| actions.iter().all(|(name, _)| *name != agent.name)) {
            Some(agent) => wrong(format!("the agent {} has no action; give each agent one", agent.name)),
            None => Ok(()),
        }
    }

    fn place(&self, name: &str) -> Result<usize, EnvError> {
        let names = || self.agents.iter().map(|agent| &*agent.name);
        names().position(|known| known == name).ok_or_else(|| {
            let all = names().collect::<Vec<_>>().join(", ");
            EnvError::Agents { message: format!("there is no agent {name}; there are {all}") }
        })
    }
}
