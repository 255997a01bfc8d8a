//! Episodes of a policy: collected by as many threads as there are, and the same ones by any number of them.
//!
//! An episode is decided by the run's seed and its own number: the environment is reset with a seed of the two, and actions are drawn from a
//! generator of the two. Rows of a network's batch have the bits that they have alone. So neither threads nor the number of environments that
//! a thread steps side by side make a difference.

use super::actor::{Actor, Head};
use super::teacher::Teacher;
use crate::error::PolicyError;
use crate::nets::Tape;
use env::episode::Summary;
use env::{Env, Rng, Success};
use random::SeedSequence;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// What the numbers that are drawn for an episode are for.
const RESET: u64 = 0;
const NOISE: u64 = 1;

/// An episode, or all of it that there is when its length is over.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Observations, one more than there are steps: `[(steps + 1) × observed]`.
    pub observations: Vec<f64>,
    /// Actions as they were drawn, `[steps × actions]`; the environment takes them within their bounds.
    pub actions: Vec<f32>,
    /// What a teacher would have done instead, `[steps × actions]`; empty where there is none.
    pub shown: Vec<f32>,
    /// The reward of each step.
    pub rewards: Vec<f64>,
    /// Whether the task ended it, so that no further reward was to be had.
    pub terminated: bool,
    /// What it adds up to.
    pub summary: Summary,
}

/// How actions are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Drawn from the policy's distribution.
    Drawn,
    /// Its mean, or its median where actions are squashed.
    Mean,
}

/// Environments of one id, those of each thread apart.
pub struct Collector {
    threads: Vec<Vec<Slot>>,
}

/// An environment, and the episode under way in it.
struct Slot {
    env: Env,
    episode: Option<(u64, Episode)>,
    rng: Rng,
    action: Vec<f64>,
    teacher: Option<Box<dyn Teacher + Send>>,
}

impl Collector {
    /// `count` environments like `env` for each of `threads` threads.
    ///
    /// # Errors
    /// The environment is hardware, which is there only once.
    pub fn new(env: &Env, count: usize, threads: usize) -> Result<Self, PolicyError> {
        let slot = || -> Result<Slot, PolicyError> {
            let action = vec![0.0; env.action_len()];
            Ok(Slot { env: env.fork()?, episode: None, rng: Rng::pcg64(0_u64), action, teacher: None })
        };
        let slots = |_| (0..count.max(1)).map(|_| slot()).collect();
        Ok(Collector { threads: (0..threads.max(1)).map(slots).collect::<Result<_, _>>()? })
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.threads.len()
    }

    /// What counts as a success.
    pub fn success(&self) -> Success {
        self.threads[0][0].env.success()
    }

    /// Lets teachers, one made for each environment, say what they would have done in every state that a policy comes to.
    ///
    /// # Errors
    /// A teacher cannot be made.
    pub fn teach(
        &mut self,
        mut make: impl FnMut(&Env) -> Result<Box<dyn Teacher + Send>, PolicyError>,
    ) -> Result<(), PolicyError> {
        for slot in self.threads.iter_mut().flatten() {
            slot.teacher = Some(make(&slot.env)?);
        }
        Ok(())
    }

    /// Plays the episodes of these numbers.
    ///
    /// # Errors
    /// An environment or a teacher fails; an environment refuses an action, gives a reward that is not finite, or has other bounds of its actions than ±1
    /// where the policy's are squashed.
    pub fn collect(
        &mut self,
        actor: &Actor,
        choice: Choice,
        seed: u64,
        numbers: Range<u64>,
    ) -> Result<Vec<Episode>, PolicyError> {
        if matches!(actor.head, Head::Squashed(_)) {
            within_one(&self.threads[0][0].env)?;
        }
        let next = AtomicU64::new(numbers.start);
        let job = Job { actor, choice, seed, next: &next, end: numbers.end };
        let parts: Vec<Result<Vec<(u64, Episode)>, PolicyError>> = match &mut self.threads[..] {
            [slots] => vec![job.play(slots)],
            threads => thread::scope(|scope| {
                let running: Vec<_> =
                    threads.iter_mut().map(|slots| scope.spawn(|| job.play(slots))).collect();
                let end = |thread: thread::ScopedJoinHandle<'_, _>| {
                    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
                };
                running.into_iter().map(end).collect()
            }),
        };
        let mut episodes = parts.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        episodes.sort_unstable_by_key(|(number, _)| *number);
        Ok(episodes.into_iter().map(|(_, episode)| episode).collect())
    }
}

/// Refuses an environment whose actions are not from -1 to 1.
fn within_one(env: &Env) -> Result<(), PolicyError> {
    match (0..env.action_len()).find(|k| env.action_bounds(*k) != [-1.0, 1.0]) {
        None => Ok(()),
        Some(k) => {
            let [low, high] = env.action_bounds(k);
            let message = format!(
                "its actions are from -1 to 1, and action {k} here is from {low} to {high}: set normalize_act=true"
            );
            Err(PolicyError::Foreign { id: env.spec().id.clone(), message })
        }
    }
}

/// What threads are to play.
struct Job<'a> {
    actor: &'a Actor,
    choice: Choice,
    seed: u64,
    next: &'a AtomicU64,
    end: u64,
}

impl Job<'_> {
    /// Plays episodes side by side until none is left, and gives those that it played.
    fn play(&self, slots: &mut [Slot]) -> Result<Vec<(u64, Episode)>, PolicyError> {
        let (mut played, mut tape, mut input) = (Vec::new(), Tape::default(), Vec::new());
        loop {
            input.clear();
            for slot in slots.iter_mut() {
                if slot.episode.is_none() {
                    self.begin(slot)?;
                }
                if slot.episode.is_some() {
                    self.actor.seen.normalize(slot.env.observation(), &mut input);
                }
            }
            if input.is_empty() {
                return Ok(played);
            }
            self.actor.forward(&input, &mut tape);
            let outputs = tape.output().chunks_exact(self.actor.net.outputs());
            for (slot, output) in slots.iter_mut().filter(|slot| slot.episode.is_some()).zip(outputs) {
                played.extend(self.step(slot, output)?);
            }
        }
    }

    /// Begins the next episode, if there is one.
    fn begin(&self, slot: &mut Slot) -> Result<(), PolicyError> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        if number >= self.end {
            return Ok(());
        }
        let draws = |purpose: u64| SeedSequence::with_spawn_key(self.seed, vec![number, purpose]);
        let [low, high] = draws(RESET).generate_state::<2>().map(u64::from);
        slot.rng = Rng::pcg64(draws(NOISE));
        let seed = high << 32 | low;
        let observations = slot.env.reset(Some(seed))?.to_vec();
        if let Some(teacher) = &mut slot.teacher {
            teacher.begin(&slot.env, seed)?;
        }
        let episode = Episode {
            observations,
            actions: Vec::new(),
            shown: Vec::new(),
            rewards: Vec::new(),
            terminated: false,
            summary: Summary::default(),
        };
        slot.episode = Some((number, episode));
        Ok(())
    }

    /// Makes a step, and gives the episode if it is over.
    fn step(&self, slot: &mut Slot, output: &[f32]) -> Result<Option<(u64, Episode)>, PolicyError> {
        let Some((_, episode)) = &mut slot.episode else { return Ok(None) };
        if let Some(teacher) = &mut slot.teacher {
            teacher.act(&slot.env, &mut slot.action)?;
            episode.shown.extend(slot.action.iter().map(|value| *value as f32));
        }
        let start = episode.actions.len();
        episode.actions.resize(start + slot.action.len(), 0.0);
        let action = &mut episode.actions[start..];
        match self.choice {
            Choice::Drawn => self.actor.draw(output, &mut slot.rng, action),
            Choice::Mean => self.actor.mean(output, action),
        }
        slot.action.iter_mut().zip(&episode.actions[start..]).for_each(|(to, from)| *to = f64::from(*from));
        let step = slot.env.step(&slot.action)?;
        if !step.reward.is_finite() {
            let id = slot.env.spec().id.clone();
            return Err(PolicyError::Reward { id, reward: step.reward, step: slot.env.steps() });
        }
        episode.observations.extend_from_slice(slot.env.observation());
        episode.rewards.push(step.reward);
        episode.terminated = step.terminated;
        episode.summary.add(&slot.env, &step);
        Ok(if step.terminated || step.truncated { slot.episode.take() } else { None })
    }
}
