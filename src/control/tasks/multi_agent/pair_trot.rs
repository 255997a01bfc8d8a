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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tasks::multi_agent::wish::push_from;
    use env::{Options, OwnModels};

    const ALONE: Wish = |facts| push_from(facts, 0.0, 1.0);
    const STANDING: Wish = |_| [0.0; 3];

    /// Distance of the box from its place at the end of an episode \[m\].
    fn left_over(wishes: Option<[Wish; 2]>) -> f64 {
        let mut env = Env::make("hive/DKittyPairPushBox-v0", &OwnModels, &Options::default()).unwrap();
        let (mut pair, mut action) = (PairTrot::new(&env).unwrap(), vec![0.0; env.action_len()]);
        if let Some(wishes) = wishes {
            pair.agents.iter_mut().zip(wishes).for_each(|(agent, wish)| agent.wish = wish);
        }
        env.reset(Some(0)).unwrap();
        pair.reset(&env, 0).unwrap();
        loop {
            pair.act(&env, &mut action).unwrap();
            let step = env.step(&action).unwrap();
            assert!(!step.terminated, "nobody falls");
            if step.truncated {
                return -env.terms()["distance"][0];
            }
        }
    }

    /// One body pushes the middle of the box while the other stands.
    #[test]
    fn the_box_is_too_heavy_for_one() {
        assert!(left_over(None) < 0.25, "two bring it to the mark");
        for wishes in [[ALONE, STANDING], [STANDING, ALONE]] {
            let distance = left_over(Some(wishes));
            assert!(distance > 0.4, "one alone brings it to {distance} m from its place");
        }
    }
}
