//! A training in progress: everything that decides how it goes on.

use super::actor::Actor;
use super::advantage::Horizon;
use super::batch::Batch;
use super::critic::{Critic, Fit};
use super::npg::{self, Npg};
use super::ppo::{self, Ppo, Update};
use super::rollout::{Choice, Collector, Episode};
use crate::archive::{Entry, Numbers};
use crate::error::PolicyError;
use crate::nets::{Activation, Adam};
use env::episode::{Evaluation, evaluate};
use env::{Env, Rng};
use random::SeedSequence;
use serde::{Deserialize, Serialize};
use std::thread;

/// What the numbers that are drawn for an iteration are for. Those of episodes have keys of another length.
const START: u64 = 0;
const POLICY: u64 = 1;
const VALUES: u64 = 2;

/// How a policy is improved.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(rename_all = "snake_case")]
pub enum Algorithm {
    /// Proximal policy optimisation.
    Ppo(Ppo),
    /// The natural policy gradient.
    Npg(Npg),
}

/// Settings of a training.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// How the policy is improved.
    pub algorithm: Algorithm,
    /// Episodes of an iteration.
    pub episodes: u64,
    /// How far rewards count.
    pub horizon: Horizon,
    /// Widths of the hidden layers of the policy, and of the value function.
    pub hidden: [Vec<usize>; 2],
    /// What follows hidden layers.
    pub activation: Activation,
    /// Logarithm of the deviations at first, and their least.
    pub log_std: [f32; 2],
    /// How the value function is fitted.
    pub fit: Fit,
}

/// A training in progress.
#[derive(Clone, Debug, PartialEq)]
pub struct Learner {
    pub(super) settings: Settings,
    pub(super) seed: u64,
    /// The policy.
    pub actor: Actor,
    /// The value function.
    pub critic: Critic,
    adam: Adam,
    /// Iterations, episodes and steps so far.
    pub iterations: u64,
    /// Episodes played.
    pub episodes: u64,
    /// Steps of the environments.
    pub samples: u64,
}

/// What an iteration did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// What its episodes, with drawn actions, add up to.
    pub evaluation: Evaluation,
    /// Deviation, most and least of their returns.
    pub spread: [f64; 3],
    /// Their mean number of steps.
    pub length: f64,
    /// Episodes that physics ended.
    pub faults: usize,
    /// What became of the policy.
    pub update: Update,
    /// Share of the variance of returns that the value function explained before it was fitted to them.
    pub explained: f64,
}

impl Learner {
    /// Before the first iteration on environments like `env`.
    pub fn new(settings: Settings, seed: u64, env: &Env) -> Self {
        let mut rng = generator(seed, &[START]);
        let (observed, actions) = (env.observation().len(), env.action_len());
        let Settings { hidden: [policy, values], activation, log_std: [log_std, least], .. } = &settings;
        let mut actor = Actor::new([observed, actions], policy, *activation, *log_std, &mut rng);
        actor.least_log_std = *least;
        let critic = Critic::new(observed, values, *activation, &mut rng);
        let adam = Adam::new(actor.parameters.len());
        Learner { settings, seed, actor, critic, adam, iterations: 0, episodes: 0, samples: 0 }
    }

    /// Collects episodes and learns from them, on two threads if the collector has more than one.
    ///
    /// # Errors
    /// An environment fails, or gives a reward that is not finite.
    pub fn iterate(&mut self, collector: &mut Collector) -> Result<Iteration, PolicyError> {
        if self.iterations == 0 {
            // What is observed is normalised from the first update on.
            let episodes = self.collect(collector)?;
            self.see(&episodes);
        }
        let episodes = self.collect(collector)?;
        let batch = Batch::new(&episodes, &self.actor, &self.critic, self.settings.horizon);
        let (settings, seed, iteration) = (&self.settings, self.seed, self.iterations);
        let (actor, critic, adam) = (&mut self.actor, &mut self.critic, &mut self.adam);
        let mut improve = || match &settings.algorithm {
            Algorithm::Ppo(ppo) => {
                ppo::update(ppo, actor, adam, &batch, &mut generator(seed, &[iteration, POLICY, 0]))
            }
            Algorithm::Npg(npg) => npg::update(npg, actor, &batch),
        };
        let mut fit = || {
            critic.fit(
                &batch.input,
                &batch.returns,
                settings.fit,
                &mut generator(seed, &[iteration, VALUES, 0]),
            )
        };
        let (update, explained) = if collector.threads() > 1 {
            thread::scope(|scope| {
                let fit = scope.spawn(fit);
                (improve(), fit.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            })
        } else {
            (improve(), fit())
        };
        self.see(&episodes);
        self.iterations += 1;
        let summaries: Vec<_> = episodes.iter().map(|episode| episode.summary.clone()).collect();
        Ok(Iteration {
            evaluation: evaluate(&summaries, collector.success()),
            spread: spread(summaries.iter().map(|summary| summary.reward)),
            length: batch.steps() as f64 / episodes.len().max(1) as f64,
            faults: summaries.iter().filter(|summary| summary.faulty).count(),
            update,
            explained,
        })
    }

    /// All that decides how it goes on, by names, but for the settings and the seed.
    pub(super) fn entries(&mut self) -> Vec<Entry<'_>> {
        let mut entries = self.actor.entries();
        entries.extend(self.critic.entries());
        entries.extend(self.adam.entries().map(|entry| entry.of("policy.adam")));
        let counts = [
            ("iterations", &mut self.iterations),
            ("episodes", &mut self.episodes),
            ("samples", &mut self.samples),
        ];
        entries.extend(
            counts.map(|(name, count)| {
                Entry::new(name, Numbers::U64(std::slice::from_mut(count))).of("training")
            }),
        );
        entries
    }

    fn collect(&mut self, collector: &mut Collector) -> Result<Vec<Episode>, PolicyError> {
        let numbers = self.episodes..self.episodes + self.settings.episodes;
        let episodes = collector.collect(&self.actor, Choice::Drawn, self.seed, numbers)?;
        self.episodes += self.settings.episodes;
        self.samples += episodes.iter().map(|episode| episode.rewards.len() as u64).sum::<u64>();
        Ok(episodes)
    }

    fn see(&mut self, episodes: &[Episode]) {
        episodes.iter().for_each(|episode| self.actor.seen.observe(&episode.observations));
    }
}

/// Deviation, most and least of numbers.
fn spread(numbers: impl Iterator<Item = f64> + Clone) -> [f64; 3] {
    let count = numbers.clone().count().max(1) as f64;
    let mean = numbers.clone().sum::<f64>() / count;
    let variance = numbers.clone().map(|number| (number - mean) * (number - mean)).sum::<f64>() / count;
    let most = numbers.clone().fold(f64::NEG_INFINITY, f64::max);
    [variance.sqrt(), most, numbers.fold(f64::INFINITY, f64::min)]
}

/// The generator of these draws of a run.
fn generator(seed: u64, key: &[u64]) -> Rng {
    Rng::pcg64(SeedSequence::with_spawn_key(seed, key))
}
