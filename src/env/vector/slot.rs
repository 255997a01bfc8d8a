//! One environment of a batch: what its last call yielded, and what happens when an episode ends.

use super::real::Real;
use crate::environment::{Env, Step};
use crate::error::EnvError;
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
            let text = payload.downcast_ref::<&str>().map(ToString::to_string);
            let message = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
            self.outcome = Err(EnvError::Panicked { message: message.clone() });
            self.broken = Some(message);
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
