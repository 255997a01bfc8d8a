//! What acts in an environment: a policy, or a controller.

use crate::failure::Failure;
use crate::input::policy::policy;
use crate::terminal::show;
use agents::Policy;
use clap::Args;
use control::Controller;
use env::Env;

/// The name that shows which controllers there are.
const LIST: &str = "list";

/// Who acts.
#[derive(Args)]
pub struct ActorArguments {
    /// What acts: random, zero, or a file with a policy: one that `train` wrote, or one made for RoboHive by mjrl (a pickle, which is not executed)
    #[arg(long, value_name = "POLICY", default_value = "random")]
    pub policy: String,
    /// A controller that solves the task without learning acts instead; `list` shows those that serve ID
    #[arg(long, value_name = "NAME", conflicts_with = "policy")]
    controller: Option<String>,
}

impl ActorArguments {
    /// What recordings say acted.
    pub fn name(&self) -> String {
        self.controller.as_ref().map_or_else(|| self.policy.clone(), |name| format!("controller {name}"))
    }

    /// The same in a sentence.
    pub fn described(&self) -> String {
        self.controller.as_ref().map_or_else(|| format!("{} policy", self.policy), |_| self.name())
    }

    /// The policy, read; it fits its environment or not when it first acts. `None` where a controller is to act.
    ///
    /// # Errors
    /// The file cannot be read, or holds no policy.
    pub fn policy(&self) -> Result<Option<Policy>, Failure> {
        if self.controller.is_some() { Ok(None) } else { policy(&self.policy).map(Some) }
    }

    /// What acts in an environment: the policy, or the controller that was named. `None` where it was asked only which there are,
    /// which is then shown.
    ///
    /// # Errors
    /// There is no such controller, or it serves other environments.
    pub fn actor(&self, policy: Option<Policy>, env: &Env) -> Result<Option<Actor>, Failure> {
        if let Some(policy) = policy {
            return Ok(Some(Actor::Policy { now: policy.clone(), policy }));
        }
        let name = self.controller.as_deref().unwrap_or(LIST);
        if name == LIST {
            show_controllers(env);
            return Ok(None);
        }
        control::make(name, env).map(|controller| Some(Actor::Controller(controller))).map_err(Failure::usage)
    }
}

/// What acts.
pub enum Actor {
    /// A policy, and its copy for the episode in progress.
    Policy {
        /// As it was read.
        policy: Policy,
        /// In the present episode.
        now: Policy,
    },
    /// A controller.
    Controller(Box<dyn Controller>),
}

impl Actor {
    /// Begins an episode, after the environment's reset with this seed.
    ///
    /// # Errors
    /// The controller cannot plan from there.
    pub fn begin(&mut self, env: &Env, seed: u64) -> Result<(), Failure> {
        match self {
            Actor::Policy { policy, now } => {
                *now = policy.for_episode(seed);
                Ok(())
            }
            Actor::Controller(controller) => controller.reset(env, seed).map_err(Failure::new),
        }
    }

    /// Chooses an action.
    ///
    /// # Errors
    /// A policy for another environment; a controller that finds no action.
    pub fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), Failure> {
        match self {
            Actor::Policy { now, .. } => now.action(env, action).map_err(Failure::usage),
            Actor::Controller(controller) => controller.act(env, action).map_err(Failure::new),
        }
    }
}

/// The controllers that serve an environment, the best first; where there are none, all.
fn show_controllers(env: &Env) {
    let id = &env.spec().id;
    let mut found = false;
    for entry in control::serving(env.spec()) {
        found = true;
        show!("{:20} {}", entry.name, entry.summary);
    }
    if !found {
        show!("no controller serves {id}; there are");
        for entry in control::controllers() {
            show!("{:20} {} (for {})", entry.name, entry.summary, entry.serves.join(", "));
        }
    }
}
