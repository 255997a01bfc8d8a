//! An environment that is played before somebody's eyes: what acts in it, and how its episode goes.

use crate::tape::{EpisodeTape, Recorded};
use agents::{Policy, PolicyError};
use dataset::trace::{Layout, Precision};
use env::episode::Summary;
use env::{Env, EnvError, Options};
use record::{COMPAT, ID, RecordError, Recording, SETTINGS};
use std::fmt;
use std::path::Path;

/// What chooses the actions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acting {
    /// Every action is zero.
    Zero,
    /// Actions are drawn uniformly from the action space.
    Random,
    /// The policy that was given.
    Policy,
    /// [`Play::hand`], which a person moves.
    Hand,
}

/// An environment, what acts in it, and its episode so far.
pub struct Play {
    env: Env,
    acting: Acting,
    random: Policy,
    policy: Option<Policy>,
    action: Vec<f64>,
    hand: Vec<f64>,
    /// Seed of the present episode.
    seed: u64,
    episode: Summary,
    /// Episodes that are over, and the sum of their successes.
    finished: usize,
    successes: f64,
    tape: Option<EpisodeTape>,
    /// How the environment was made, for its recordings.
    made: Options,
}

/// Why an environment cannot go on.
#[derive(Debug)]
pub enum PlayError {
    /// It refuses the action or its first state.
    Env(Box<EnvError>),
    /// The policy is one for another environment.
    Policy(Box<PolicyError>),
    /// The recording cannot go on; the episodes before are in the file.
    Record(Box<RecordError>),
}

impl Play {
    /// The first episode of an environment, with actions drawn at random, or by a policy where there is one.
    ///
    /// # Errors
    /// The environment refuses its first state.
    pub fn new(env: Env, policy: Option<Policy>, seed: u64) -> Result<Self, PlayError> {
        let hand = vec![0.0; env.action_len()];
        let mut play = Play {
            acting: if policy.is_some() { Acting::Policy } else { Acting::Random },
            random: Policy::random(seed),
            policy,
            action: hand.clone(),
            hand,
            seed,
            episode: Summary::default(),
            finished: 0,
            successes: 0.0,
            tape: None,
            made: Options::default(),
            env,
        };
        play.begin(seed)?;
        Ok(play)
    }

    /// Says how the environment was made, where that is not by default: recordings name it.
    pub fn made_by(self, options: Options) -> Self {
        Play { made: options, ..self }
    }

    /// The environment.
    pub fn env(&self) -> &Env {
        &self.env
    }

    /// What acts.
    pub fn acting(&self) -> Acting {
        self.acting
    }

    /// Lets something else act. Without a policy there is none to choose.
    pub fn let_act(&mut self, acting: Acting) {
        if acting != Acting::Policy || self.policy.is_some() {
            self.acting = acting;
        }
    }

    /// Whether there is a policy.
    pub fn has_policy(&self) -> bool {
        self.policy.is_some()
    }

    /// The action that a person moves, within [`Env::action_bounds`].
    pub fn hand(&mut self) -> &mut [f64] {
        &mut self.hand
    }

    /// The last action.
    pub fn action(&self) -> &[f64] {
        &self.action
    }

    /// Seed of the present episode; the next has the next one.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The present episode.
    pub fn episode(&self) -> &Summary {
        &self.episode
    }

    /// Episodes that are over, and the share of them that were a success.
    pub fn finished(&self) -> (usize, f64) {
        (self.finished, self.successes / self.finished.max(1) as f64)
    }

    /// Whether the present episode is over: then the next step begins another.
    pub fn is_over(&self) -> bool {
        self.episode.terminated || self.episode.truncated
    }

    /// One control period under wrenches on bodies (`[nbody]`, force and torque in the world's frame \[N, N m\]); after the
    /// last step of an episode, the start of the next.
    ///
    /// # Errors
    /// What acts is for another environment; the first state of an episode is refused.
    pub fn step(&mut self, wrenches: &[[f64; 6]]) -> Result<(), PlayError> {
        if self.is_over() {
            return self.begin(self.seed.wrapping_add(1));
        }
        match (self.acting, &mut self.policy) {
            (Acting::Policy, Some(policy)) => policy.action(&self.env, &mut self.action)?,
            (Acting::Random, _) => self.random.action(&self.env, &mut self.action)?,
            (Acting::Hand, _) => self.action.copy_from_slice(&self.hand),
            (Acting::Zero | Acting::Policy, _) => self.action.fill(0.0),
        }
        self.tape.as_mut().map_or(Ok(()), |tape| tape.row(&self.env, &self.action))?;
        self.env.push_bodies(wrenches);
        let step = self.env.step(&self.action)?;
        self.episode.add(&self.env, &step);
        if self.is_over() {
            self.finished += 1;
            self.successes += self.episode.success(self.env.success());
            self.tape.as_mut().map_or(Ok(()), |tape| tape.end(&self.env))?;
        }
        Ok(())
    }

    /// Records the episodes that begin from now on: see [`Session::record`](crate::Session::record).
    pub(crate) fn record(&mut self, path: &Path) -> Result<(), PlayError> {
        let (compat, settings) = (self.made.compat.to_string(), self.made.changes.to_string());
        let attributes = [(ID, &self.env.spec().id[..]), (COMPAT, &compat), (SETTINGS, settings.trim_end())];
        let recording = Recording::create(path, Layout::RoboHive, Precision::Full, &attributes)?;
        self.tape = Some(EpisodeTape::new(recording, path));
        Ok(())
    }

    /// The recording that goes on.
    pub(crate) fn recording(&self) -> Option<Recorded> {
        self.tape.as_ref().map(EpisodeTape::so_far)
    }

    pub(crate) fn stop_recording(&mut self) -> Result<Option<Recorded>, PlayError> {
        Ok(self.tape.take().map(EpisodeTape::finish).transpose()?)
    }

    /// The first state of the episode of a seed.
    ///
    /// # Errors
    /// The environment refuses it.
    pub fn begin(&mut self, seed: u64) -> Result<(), PlayError> {
        self.seed = seed;
        self.episode = Summary::default();
        // As `robohive run` draws them, so that it plays the same episode.
        self.random = Policy::random(seed);
        self.env.reset(Some(seed))?;
        if let Some(tape) = &mut self.tape {
            tape.begin(seed);
        }
        Ok(())
    }
}

impl fmt::Display for PlayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlayError::Env(error) => write!(f, "{error}"),
            PlayError::Policy(error) => write!(f, "{error}"),
            PlayError::Record(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for PlayError {}

impl From<EnvError> for PlayError {
    fn from(error: EnvError) -> Self {
        PlayError::Env(Box::new(error))
    }
}

impl From<PolicyError> for PlayError {
    fn from(error: PolicyError) -> Self {
        PlayError::Policy(Box::new(error))
    }
}

impl From<RecordError> for PlayError {
    fn from(error: RecordError) -> Self {
        PlayError::Record(Box::new(error))
    }
}
