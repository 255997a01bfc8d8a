//! What acts in an environment: a policy, or a controller.

use crate::failure::Failure;
use crate::input::policy::{BEST, policy, shipped};
use crate::terminal::{note, show};
use agents::Policy;
use clap::Args;
use control::Controller;
use env::Env;

/// The name that shows which controllers there are.
const LIST: &str = "list";

/// Who acts.
#[derive(Args)]
pub struct ActorArguments {
    /// What acts: best, the policy that is shipped for ID or else the controller that serves it best; random; zero; or a file with a policy: one that
    /// `train` wrote, or one made for RoboHive by mjrl (a pickle, which is not executed)
    #[arg(long, value_name = "POLICY", default_value = "random")]
    pub policy: String,
    /// A controller that solves the task without learning acts instead; `list` shows those that serve ID
    #[arg(long, value_name = "NAME", conflicts_with = "policy")]
    controller: Option<String>,
}

impl ActorArguments {
    /// What recordings say acts in an environment.
    pub fn name(&self, env: &Env) -> String {
        self.controller(env).map_or_else(|| self.policy.clone(), |name| format!("controller {name}"))
    }

    /// The same in a sentence.
    pub fn described(&self, env: &Env) -> String {
        self.controller(env).map_or_else(|| format!("{} policy", self.policy), |_| self.name(env))
    }

    /// The controller that acts: the one that was named, or that stands in for a policy that is not shipped.
    fn controller(&self, env: &Env) -> Option<&str> {
        let stands_in = || {
            let wanted = self.policy == BEST && assets::policy(&env.spec().id).is_none();
            wanted.then(|| control::serving(env.spec()).next()).flatten().map(|entry| entry.name)
        };
        self.controller.as_deref().or_else(stands_in)
    }

    /// The policy for the environments of an id, read; it fits them or not when it first acts. `None` where a controller is to act.
    ///
    /// # Errors
    /// The file cannot be read, or holds no policy.
    pub fn policy(&self, id: &str) -> Result<Option<Policy>, Failure> {
        match (&self.controller, &self.policy[..]) {
            (Some(_), _) => Ok(None),
            (None, BEST) => shipped(id),
            (None, name) => policy(name, Some(id)).map(Some),
        }
    }

    /// What acts in an environment: the policy, or a controller. `None` where it was asked only which controllers there are, which are then
    /// shown.
    ///
    /// # Errors
    /// There is no such controller, or it serves other environments; there is neither a policy nor a controller.
    pub fn actor(&self, policy: Option<Policy>, env: &Env) -> Result<Option<Actor>, Failure> {
        if let Some(policy) = policy {
            return Ok(Some(Actor::Policy { now: policy.clone(), policy }));
        }
        let id = &env.spec().id;
        let name = self.controller(env).ok_or_else(|| {
            Failure::usage(format!(
                "no policy is shipped for {id}, and no controller is made for it; `robohive train {id}` trains a policy, `--controller planner` plans"
            ))
        })?;
        if name == LIST {
            show_controllers(env);
            return Ok(None);
        }
        if self.controller.is_none() {
            note(&format!("no policy is shipped for {id}: the controller {name} acts"));
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
        show!("no controller is made for {id}; planner plays any environment, and there are");
        for entry in control::controllers() {
            show!("{:20} {} (for {})", entry.name, entry.summary, entry.serves.join(", "));
        }
    }
}
