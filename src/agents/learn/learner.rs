//! A training in progress: everything that decides how it goes on.

use super::actor::Actor;
use super::advantage::Horizon;
use super::batch::Batch;
use super::cloning;
use super::critic::Critic;
use super::dapg::{self, Dapg};
use super::demonstrations::Demonstrations;
use super::fit::Fit;
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
const CLONE: u64 = 3;

/// How a policy is improved.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(rename_all = "snake_case")]
pub enum Algorithm {
    /// Proximal policy optimisation.
    Ppo(Ppo),
    /// The natural policy gradient.
    Npg(Npg),
    /// Behaviour cloning: episodes are played to see what became of it, and only demonstrations are learnt from.
    Cloning(Fit),
    /// The natural policy gradient with demonstrations.
    Dapg(Dapg),
}

impl Algorithm {
    /// Its name in short.
    pub fn name(&self) -> &'static str {
        match self {
            Algorithm::Ppo(_) => "ppo",
            Algorithm::Npg(_) => "npg",
            Algorithm::Cloning(_) => "bc",
            Algorithm::Dapg(_) => "dapg",
        }
    }

    /// Whether it learns from demonstrations.
    pub fn needs_demonstrations(&self) -> bool {
        matches!(self, Algorithm::Cloning(_) | Algorithm::Dapg(_))
    }
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
    demonstrations: Option<Demonstrations>,
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
        let demonstrations = None;
        Learner {
            settings,
            seed,
            actor,
            critic,
            adam,
            demonstrations,
            iterations: 0,
            episodes: 0,
            samples: 0,
        }
    }

    /// Learns from these demonstrations, too. Before the first iteration the policy is cloned from them where the algorithm says so.
    pub fn teach(&mut self, demonstrations: Demonstrations) {
        self.demonstrations = Some(demonstrations);
    }

    /// Collects episodes and learns from them, on two threads if the collector has more than one.
    ///
    /// # Errors
    /// An environment fails, or gives a reward that is not finite; an algorithm that learns from demonstrations has none.
    pub fn iterate(&mut self, collector: &mut Collector) -> Result<Iteration, PolicyError> {
        let taught = self.settings.algorithm.needs_demonstrations();
        if taught != self.demonstrations.is_some() {
            let message = if taught {
                "it learns from demonstrations, and there are none"
            } else {
                "it does not learn from demonstrations"
            };
            return Err(PolicyError::content(message));
        }
        if self.iterations == 0 {
            self.prepare(collector)?;
        }
        let episodes = self.collect(collector)?;
        let batch = Batch::new(&episodes, &self.actor, &self.critic, self.settings.horizon);
        // Without demonstrations the algorithm is one that has no use for them.
        let shown = self.demonstrations.as_ref().map_or(Batch::default(), |shown| shown.batch(&self.actor));
        let (settings, seed, iteration) = (&self.settings, self.seed, self.iterations);
        let (actor, critic, adam) = (&mut self.actor, &mut self.critic, &mut self.adam);
        let mut improve = || {
            let mut rng = generator(seed, &[iteration, POLICY, 0]);
            match &settings.algorithm {
                Algorithm::Ppo(ppo) => ppo::update(ppo, actor, adam, &batch, &mut rng),
                Algorithm::Npg(npg) => npg::update(npg, actor, &batch),
                Algorithm::Cloning(cloning) => cloning::update(cloning, actor, adam, &shown, &mut rng),
                Algorithm::Dapg(dapg) => dapg::update(dapg, iteration, actor, &batch, &shown),
            }
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
        // A clone is shown the same observations again, and has no use for other ones.
        if !matches!(self.settings.algorithm, Algorithm::Cloning(_)) {
            self.see(&episodes);
        }
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

    /// Finds how observations are to be normalised, from demonstrations or else from episodes that are not learnt from, and clones the
    /// policy where the algorithm begins with that.
    fn prepare(&mut self, collector: &mut Collector) -> Result<(), PolicyError> {
        let Some(demonstrations) = &self.demonstrations else {
            let episodes = self.collect(collector)?;
            self.see(&episodes);
            return Ok(());
        };
        self.actor.seen.observe(demonstrations.observations());
        if let Algorithm::Dapg(Dapg { cloning, .. }) = &self.settings.algorithm {
            let (shown, mut rng) = (demonstrations.batch(&self.actor), generator(self.seed, &[CLONE]));
            // With an optimiser of its own: that of the policy has seen nothing when the first gradient comes.
            let mut adam = Adam::new(self.actor.parameters.len());
            cloning::update(cloning, &mut self.actor, &mut adam, &shown, &mut rng);
        }
        Ok(())
    }

    /// All that decides how it goes on, by names, but for the settings, the seed and demonstrations.
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
