//! One environment of a batch: what its last call yielded, and what happens when an episode ends.

use super::real::Real;
use crate::environment::{Env, Step};
use crate::error::{EnvError, panic_text};
use crate::rows::Rows;
use crate::task::Verdict;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What happens after an episode has ended (Gymnasium's `AutoresetMode`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autoreset {
    /// The next step ignores its action and resets.
    #[default]
    NextStep,
    /// The step that ends an episode resets; what it ended with is kept aside ([`Final`]).
    SameStep,
    /// Nothing: the caller resets.
    Disabled,
}

/// What an episode ended with, where the same step has started the next one.
#[derive(Clone, Debug, Default)]
pub struct Final {
    /// The observation vector.
    pub observation: Vec<f64>,
    /// The observation dictionary.
    pub rows: Rows,
    /// The terms of the reward, before their weights.
    pub terms: Rows,
    /// What the reward decides beside its terms.
    pub verdict: Verdict,
    /// The weighted sum of the terms.
    pub dense: f64,
}

impl Final {
    fn take(&mut self, env: &Env) {
        self.observation.clear();
        self.observation.extend_from_slice(env.observation());
        self.rows.clone_from(env.rows());
        self.terms.clone_from(env.terms());
        self.verdict = env.verdict();
        self.dense = env.dense();
    }
}

/// What the last call of an environment yielded, in few bytes. Those of a batch lie side by side, so that reading all of them
/// touches no environment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepRecord {
    /// The reward; 0 after a reset.
    pub reward: f64,
    /// The task ended the episode.
    pub terminated: bool,
    /// The episode is over for another reason.
    pub truncated: bool,
    /// The episode is over, and nothing has reset since.
    pub ended: bool,
    /// The episode was over, and the same step has reset.
    pub replaced: bool,
    /// Physics refused the step: [`Step::fault`].
    pub faulty: bool,
    /// Simulation time \[s\].
    pub time: f64,
    /// The weighted sum of the terms of the reward in the present state.
    pub dense: f64,
    /// What the reward decides beside it.
    pub verdict: Verdict,
    /// The call failed.
    pub(super) failed: bool,
}

/// What one environment is to do.
#[derive(Clone, Copy, Debug)]
pub enum Order {
    /// Start an episode, seeded or not.
    Reset(Option<u64>),
    /// Take a step with [`Slot::action`].
    Step,
}

/// An environment and what its last call yielded.
pub struct Slot {
    pub env: Env,
    /// The action of the next step.
    pub action: Vec<f64>,
    pub outcome: Result<Step, EnvError>,
    /// The last step ended the episode, and nothing has reset since.
    pub ended: bool,
    autoreset: Autoreset,
    replaced: bool,
    last: Final,
    /// A panic in this environment, which has left it in no defined state.
    broken: Option<String>,
}

const QUIET: Step = Step { reward: 0.0, terminated: false, truncated: false, fault: None };

impl Slot {
    pub fn new(env: Env, autoreset: Autoreset) -> Self {
        Slot {
            action: vec![0.0; env.action_len()],
            env,
            outcome: Ok(QUIET),
            ended: false,
            autoreset,
            replaced: false,
            last: Final::default(),
            broken: None,
        }
    }

    /// Another one in the same state.
    ///
    /// # Errors
    /// The robot is hardware.
    pub fn fork(&self) -> Result<Self, EnvError> {
        Ok(Slot {
            env: self.env.fork()?,
            action: self.action.clone(),
            outcome: self.outcome.as_ref().map_or(Ok(QUIET), |step| Ok(step.clone())),
            ended: self.ended,
            autoreset: self.autoreset,
            replaced: self.replaced,
            last: self.last.clone(),
            broken: self.broken.clone(),
        })
    }

    /// Sets the action of the next step.
    pub fn set_action<A: Real>(&mut self, action: &[A]) {
        self.action.iter_mut().zip(action).for_each(|(to, from)| *to = from.to_f64());
    }

    /// Carries an order out. What it yields stands in `outcome`; a panic becomes an error, then and ever after.
    pub fn run(&mut self, order: Order) {
        if let Some(message) = &self.broken {
            self.outcome = Err(EnvError::Panicked { message: message.clone() });
            return;
        }
        let done = catch_unwind(AssertUnwindSafe(|| match order {
            Order::Reset(seed) => self.reset(seed),
            Order::Step => self.step(),
        }));
        if let Err(payload) = done {
            let message = panic_text(&*payload);
            self.outcome = Err(EnvError::Panicked { message: message.clone() });
            self.broken = Some(message);
        }
    }

    /// What the last call yielded.
    pub fn record(&self) -> StepRecord {
        let step = self.outcome.as_ref().unwrap_or(&QUIET);
        StepRecord {
            reward: step.reward,
            terminated: step.terminated,
            truncated: step.truncated,
            ended: self.ended,
            replaced: self.replaced,
            faulty: step.fault.is_some(),
            time: self.env.rows().values()[0],
            dense: self.env.dense(),
            verdict: self.env.verdict(),
            failed: self.outcome.is_err(),
        }
    }

    /// Writes the observation of the current state.
    pub fn write<T: Real>(&self, observation: &mut [T]) {
        observation.iter_mut().zip(self.env.observation()).for_each(|(to, from)| *to = T::from_f64(*from));
    }

    /// What the episode ended with that the last call replaced.
    pub fn last(&self) -> Option<&Final> {
        self.replaced.then_some(&self.last)
    }

    /// Takes the error of the last call out.
    pub fn take_error(&mut self) -> Result<(), EnvError> {
        if self.outcome.is_err() {
            std::mem::replace(&mut self.outcome, Ok(Step { truncated: true, ..QUIET }))?;
        }
        Ok(())
    }

    fn reset(&mut self, seed: Option<u64>) {
        (self.ended, self.replaced) = (false, false);
        self.outcome = self.env.reset(seed).map(|_| QUIET);
    }

    fn step(&mut self) {
        if self.ended && self.autoreset == Autoreset::NextStep {
            return self.reset(None);
        }
        self.replaced = false;
        self.outcome = self.env.step(&self.action);
        let Ok(step) = &self.outcome else { return };
        self.ended = step.terminated || step.truncated;
        if self.ended && self.autoreset == Autoreset::SameStep {
            let step = step.clone();
            self.last.take(&self.env);
            self.reset(None);
            self.replaced = true;
            if self.outcome.is_ok() {
                self.outcome = Ok(step);
            }
        }
    }
}
