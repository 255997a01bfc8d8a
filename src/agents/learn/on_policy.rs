//! Learning from what the present policy did: its episodes judged by a value function, which is fitted to them meanwhile.

use super::actor::Actor;
use super::batch::Batch;
use super::critic::Critic;
use super::dapg::Dapg;
use super::demonstrations::Demonstrations;
use super::fit::Fit;
use super::npg::Npg;
use super::ppo::Ppo;
use super::rollout::Episode;
use super::settings::Settings;
use super::update::Update;
use super::{cloning, dapg, npg, ppo};
use crate::archive::Entry;
use crate::nets::Adam;
use env::Rng;
use std::thread;

/// How a policy is improved by its latest episodes, or beside them by demonstrations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Proximal policy optimisation.
    Ppo(Ppo),
    /// The natural policy gradient.
    Npg(Npg),
    /// Behaviour cloning.
    Cloning(Fit),
    /// The natural policy gradient with demonstrations.
    Dapg(Dapg),
}

/// What algorithms have beside the policy that learn from its latest episodes.
#[derive(Clone, Debug, PartialEq)]
pub struct OnPolicy {
    rule: Rule,
    critic: Critic,
    adam: Adam,
}

impl OnPolicy {
    /// Before the first iteration.
    pub fn new(rule: Rule, settings: &Settings, actor: &Actor, rng: &mut Rng) -> Self {
        let critic = Critic::new(actor.net.inputs(), &settings.hidden[1], settings.activation, rng);
        OnPolicy { rule, critic, adam: Adam::new(actor.parameters.len()) }
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
        let OnPolicy { rule, critic, adam } = self;
        let batch = Batch::new(episodes, actor, critic, settings.horizon);
        // Without demonstrations the algorithm is one that has no use for them.
        let shown = demonstrations.map_or(Batch::default(), |shown| shown.batch(actor));
        let mut improve = || match rule {
            Rule::Ppo(ppo) => ppo::update(ppo, actor, adam, &batch, &mut rng),
            Rule::Npg(npg) => npg::update(npg, actor, &batch),
            Rule::Cloning(cloning) => cloning::update(cloning, actor, adam, &shown, &mut rng),
            Rule::Dapg(dapg) => dapg::update(dapg, iteration, actor, &batch, &shown),
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
