//! Learning from what the present policy did: its episodes judged by a value function, which is fitted to them meanwhile.

use super::actor::Actor;
use super::batch::Batch;
use super::critic::Critic;
use super::demonstrations::Demonstrations;
use super::ppo::Update;
use super::rollout::Episode;
use super::settings::{Algorithm, Settings};
use super::{cloning, dapg, npg, ppo};
use crate::archive::Entry;
use crate::nets::Adam;
use env::Rng;
use std::thread;

/// What algorithms have beside the policy that learn from its latest episodes.
#[derive(Clone, Debug, PartialEq)]
pub struct OnPolicy {
    critic: Critic,
    adam: Adam,
}

impl OnPolicy {
    /// Before the first iteration.
    pub fn new(settings: &Settings, actor: &Actor, rng: &mut Rng) -> Self {
        let critic = Critic::new(actor.net.inputs(), &settings.hidden[1], settings.activation, rng);
        OnPolicy { critic, adam: Adam::new(actor.parameters.len()) }
    }

    /// Improves a policy by its episodes of an iteration, on two threads if there are more than one; gives what became of it, and
    /// the share of the variance of returns that the values explained.
    pub fn improve(
        &mut self,
        settings: &Settings,
        actor: &mut Actor,
        (episodes, demonstrations): (&[Episode], Option<&Demonstrations>),
        (iteration, threads): (u64, usize),
        [mut rng, mut rng_of_values]: [Rng; 2],
    ) -> (Update, f64) {
        let OnPolicy { critic, adam } = self;
        let batch = Batch::new(episodes, actor, critic, settings.horizon);
        // Without demonstrations the algorithm is one that has no use for them.
        let shown = demonstrations.map_or(Batch::default(), |shown| shown.batch(actor));
        let mut improve = || match &settings.algorithm {
            Algorithm::Ppo(ppo) => ppo::update(ppo, actor, adam, &batch, &mut rng),
            Algorithm::Npg(npg) => npg::update(npg, actor, &batch),
            Algorithm::Cloning(cloning) => cloning::update(cloning, actor, adam, &shown, &mut rng),
            Algorithm::Dapg(dapg) => dapg::update(dapg, iteration, actor, &batch, &shown),
            Algorithm::Sac(_) => Update::default(),
        };
        let mut fit = || critic.fit(&batch.input, &batch.returns, settings.fit, &mut rng_of_values);
        if threads > 1 {
            thread::scope(|scope| {
                let fit = scope.spawn(fit);
                (improve(), fit.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            })
        } else {
            (improve(), fit())
        }
    }

    /// All of it, by names.
    pub fn entries(&mut self) -> Vec<Entry<'_>> {
        let mut entries = self.critic.entries();
        entries.extend(self.adam.entries().map(|entry| entry.of("policy.adam")));
        entries
    }
}
