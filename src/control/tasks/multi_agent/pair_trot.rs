//! Two bodies with four legs, each an agent: both trot at velocities that follow from what each of them observes.

use super::wish::wish;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::tasks::locomotion::trot::Trotter;
use crate::tasks::locomotion::wish::Wish;
use env::Env;
use env::team::prefix;

/// An agent: what its rows begin with, its body, what it wants.
struct Agent {
    prefix: String,
    body: Trotter,
    wish: Wish,
}

/// The controller.
pub struct PairTrot {
    agents: Vec<Agent>,
    controls: Vec<f64>,
}

impl PairTrot {
    /// The controller of all agents of an environment, bodies with four legs.
    ///
    /// # Errors
    /// An environment for one agent; a body that has not four feet, or whose legs are not of servos.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let team = env.team().ok_or_else(|| ControlError::unfit(env, "it is for one agent"))?;
        let agent = |name: &str| {
            let (prefix, wish) = (prefix(name), wish(&env.spec().task, name));
            Ok::<_, ControlError>(Agent { body: Trotter::new(env, &prefix)?, prefix, wish })
        };
        let agents = team.agents().iter().map(|it| agent(it.name())).collect::<Result<_, _>>()?;
        Ok(PairTrot { agents, controls: vec![0.0; env.scene().model.nu] })
    }
}

impl Controller for PairTrot {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.agents.iter_mut().for_each(|agent| agent.body.restart(env));
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        for agent in &mut self.agents {
            let rows = env.rows().of(&agent.prefix);
            let wanted = (agent.wish)(&agent.body.facts(rows));
            agent.body.trot(env, rows, wanted, &mut self.controls);
        }
        command(env, &self.controls, action)
    }
}
