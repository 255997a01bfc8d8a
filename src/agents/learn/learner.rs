//! A training in progress: everything that decides how it goes on.

use super::actor::Actor;
use super::cloning;
use super::dapg::Dapg;
use super::demonstrations::Demonstrations;
use super::method::Method;
use super::rollout::{Choice, Collector, Episode};
use super::settings::{Algorithm, Settings};
use super::update::Update;
use crate::archive::{self, Archive, Entry, Numbers};
use crate::error::PolicyError;
use crate::nets::Adam;
use env::episode::{Evaluation, evaluate};
use env::{Env, Rng};
use random::SeedSequence;

/// What the numbers that are drawn for an iteration are for. Those of episodes have keys of another length.
const START: u64 = 0;
const POLICY: u64 = 1;
const VALUES: u64 = 2;
const CLONE: u64 = 3;

/// A training in progress.
#[derive(Clone, Debug, PartialEq)]
pub struct Learner {
    pub(super) settings: Settings,
    pub(super) seed: u64,
    /// The policy.
    pub actor: Actor,
    method: Method,
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
        let actor = Actor::new(
            [observed, actions],
            &settings.hidden[0],
            settings.activation,
            settings.head(),
            &mut rng,
        );
        let method = Method::new(&settings, &actor, &mut rng);
        let demonstrations = None;
        Learner { settings, seed, actor, method, demonstrations, iterations: 0, episodes: 0, samples: 0 }
    }

    /// Learns from these demonstrations, too. Before the first iteration the policy is cloned from them where the algorithm says so.
    pub fn teach(&mut self, demonstrations: Demonstrations) {
        self.demonstrations = Some(demonstrations);
    }

    /// What it learns from besides, with what was corrected so far.
    pub(crate) fn demonstrations(&mut self) -> Option<&mut Demonstrations> {
        self.demonstrations.as_mut()
    }

    /// Collects episodes and learns from them, on two threads if the collector has more than one.
    ///
    /// # Errors
    /// An environment fails, or gives a reward that is not finite; an algorithm that learns from demonstrations or corrections has none.
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
        if let Some(demonstrations) =
            self.demonstrations.as_mut().filter(|_| self.settings.algorithm.needs_corrections())
        {
            demonstrations.correct(&episodes)?;
        }
        let steps: usize = episodes.iter().map(|episode| episode.rewards.len()).sum();
        let (settings, seed, iteration) = (&self.settings, self.seed, self.iterations);
        let (actor, threads) = (&mut self.actor, collector.threads());
        let rngs = [POLICY, VALUES].map(|purpose| generator(seed, &[iteration, purpose, 0]));
        let (update, explained) = match &mut self.method {
            Method::Soft(soft) => {
                let [mut rng, _] = rngs;
                soft.remember(&episodes, settings.horizon.gamma);
                soft.improve((settings.fit, settings.horizon.gamma), actor, (steps, threads), &mut rng)
            }
            Method::OnPolicy(method) => {
                let shown = (&episodes[..], self.demonstrations.as_ref());
                method.improve(settings, actor, shown, (iteration, threads), rngs)
            }
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
            length: steps as f64 / episodes.len().max(1) as f64,
            faults: summaries.iter().filter(|summary| summary.faulty).count(),
            update,
            explained,
        })
    }

    /// Finds how observations are to be normalised, from demonstrations or else from episodes that are only learnt from where they are
    /// remembered, and clones the policy where the algorithm begins with that.
    fn prepare(&mut self, collector: &mut Collector) -> Result<(), PolicyError> {
        let Some(demonstrations) = &self.demonstrations else {
            let episodes = self.collect(collector)?;
            self.see(&episodes);
            if let Method::Soft(soft) = &mut self.method {
                soft.remember(&episodes, self.settings.horizon.gamma);
            }
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
        entries.extend(self.method.entries());
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

    /// Refuses to remember more than a checkpoint can hold.
    pub(crate) fn check_size(&self) -> Result<(), PolicyError> {
        match &self.method {
            Method::Soft(soft) if soft.most_bytes() > archive::MAX_CHECKPOINT_BYTES / 2 => {
                let (needed, most) = (soft.most_bytes() >> 20, archive::MAX_CHECKPOINT_BYTES >> 21);
                let message = format!(
                    "algorithm.sac.remembered observations of this environment are {needed} MiB, and {most} can be kept: remember fewer"
                );
                Err(PolicyError::content(message))
            }
            _ => Ok(()),
        }
    }

    /// Takes all that decides how it goes on from a file.
    pub(super) fn fill(&mut self, archive: &Archive<'_>) -> Result<(), PolicyError> {
        if let Method::Soft(soft) = &mut self.method {
            soft.make_room(archive)?;
        }
        archive.fill(self.entries())?;
        match &self.method {
            Method::Soft(soft) => soft.check(),
            Method::OnPolicy(_) => Ok(()),
        }
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
