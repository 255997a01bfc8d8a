//! Batched stepping: many simulations side by side on a pool of threads.
//!
//! Every environment has its own [`Data`] and a payload of the caller's: a task, a random generator, an episode. The
//! [`Model`] is one for all until an environment edits its own, which copies it. Working memory belongs to the threads,
//! not to the environments. An environment reads nothing of another, so the result does not depend on the number of
//! threads, to the last bit.
//!
//! ```
//! use robohive_physics::{Batch, step};
//!
//! let text = "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let ball = model.body("ball").ok_or("no ball")?;
//! // Each environment counts the steps until its ball has fallen 10 cm.
//! let mut batch = Batch::with_payloads(model, vec![0_u32; 8], 2)?;
//! batch.edit_model(3, |m| m.opt.gravity = [0.0, 0.0, -1.6])?;
//! batch.run(|env| {
//!     while env.data.body(ball).xpos()[2] > -0.1 {
//!         step(env.model, env.data)?;
//!         *env.payload += 1;
//!     }
//!     Ok::<_, robohive_physics::StepError>(())
//! })?;
//! assert!(batch.payloads()[3] > 2 * batch.payloads()[0]);
//! batch.only(&[0, 3]).step(10)?;
//! assert!(batch.data()[0].time() > batch.data()[1].time());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::{Data, Scratch};
use crate::edit::EditError;
use crate::model::{Draft, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::step::step;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Environments that are stepped together, each with a payload `P`.
#[derive(Debug)]
pub struct Batch<P = ()> {
    models: Vec<Arc<Model>>,
    data: Vec<Data>,
    payloads: Vec<P>,
    /// Which environments the next run visits.
    selected: Vec<bool>,
    /// Working memory, one for each thread; the environments' own stays empty.
    workers: Vec<Scratch>,
    #[cfg(feature = "threads")]
    pool: Option<rayon::ThreadPool>,
}

/// One environment of a batch, lent to a run.
#[derive(Debug)]
pub struct Environment<'a, P> {
    /// Index in the batch.
    pub index: usize,
    /// Its model.
    pub model: &'a Model,
    /// Its state and stage outputs.
    pub data: &'a mut Data,
    /// What the caller keeps with it.
    pub payload: &'a mut P,
}

/// An environment that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure<E> {
    /// Index in the batch.
    pub environment: usize,
    /// What was wrong with it.
    pub error: E,
}

/// Environments of a batch failed; all others were run.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchError<E = StepError> {
    /// Every environment that failed, at least one, by index.
    pub failures: Vec<Failure<E>>,
}

/// Failed environments that a message lists.
const LISTED: usize = 8;

impl<E: fmt::Display> fmt::Display for BatchError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let [first, ..] = &self.failures[..] {
            write!(f, "environment {}: {}", first.environment, first.error)?;
        }
        if let [_, others @ ..] = &self.failures[..]
            && !others.is_empty()
        {
            let listed: Vec<_> = others.iter().take(LISTED).map(|o| o.environment.to_string()).collect();
            let more = if others.len() > LISTED { ", …" } else { "" };
            write!(f, " ({} more failed: {}{more})", others.len(), listed.join(", "))?;
        }
        Ok(())
    }
}

impl<E: std::error::Error + 'static> std::error::Error for BatchError<E> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.failures.first().map(|first| &first.error as _)
    }
}

/// The operating system refused to start the threads of a batch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ThreadsError {
    /// Threads asked for.
    pub threads: usize,
    /// Its reason.
    pub reason: String,
}

impl fmt::Display for ThreadsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} threads cannot be started: {}", self.threads, self.reason)
    }
}

impl std::error::Error for ThreadsError {}

impl Batch {
    /// Environments at the reference configuration of `model`. With one thread (0 counts as one), or without the
    /// feature `threads`, the caller's thread does all work.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn new(
        model: impl Into<Arc<Model>>,
        environments: usize,
        threads: usize,
    ) -> Result<Self, ThreadsError> {
        Batch::with_payloads(model, vec![(); environments], threads)
    }
}

impl<P> Batch<P> {
    /// One environment for each payload, otherwise as [`Batch::new`].
    ///
    /// # Errors
    /// As [`Batch::new`].
    pub fn with_payloads(
        model: impl Into<Arc<Model>>,
        payloads: Vec<P>,
        threads: usize,
    ) -> Result<Self, ThreadsError> {
        let (model, environments) = (model.into(), payloads.len());
        #[cfg(not(feature = "threads"))]
        let threads = threads.min(1);
        Ok(Batch {
            data: vec![Data::new(&model); environments],
            models: vec![model; environments],
            payloads,
            selected: vec![true; environments],
            workers: vec![Scratch::default(); threads.max(1)],
            #[cfg(feature = "threads")]
            pool: if threads > 1 { Some(start_threads(threads)?) } else { None },
        })
    }

    /// Number of environments.
    pub fn len(&self) -> usize {
        self.data.len()
    }

    /// True without environments.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// State and stage outputs of every environment.
    pub fn data(&self) -> &[Data] {
        &self.data
    }

    /// The same, to set states and inputs.
    pub fn data_mut(&mut self) -> &mut [Data] {
        &mut self.data
    }

    /// Payload of every environment.
    pub fn payloads(&self) -> &[P] {
        &self.payloads
    }

    /// The same, to write.
    pub fn payloads_mut(&mut self) -> &mut [P] {
        &mut self.payloads
    }

    /// Model of an environment.
    pub fn model(&self, environment: usize) -> &Arc<Model> {
        &self.models[environment]
    }

    /// Edits the model of an environment, see [`Model::edit`]: shared until now, it becomes the environment's own copy.
    ///
    /// # Errors
    /// Those of [`Model::edit`]; the environment keeps its model.
    pub fn edit_model(
        &mut self,
        environment: usize,
        change: impl FnOnce(&mut Draft<'_>),
    ) -> Result<(), EditError> {
        Arc::make_mut(&mut self.models[environment]).edit(change)
    }
}

impl<P: Send> Batch<P> {
    /// The environments with these indices, to be stepped or run without the others.
    ///
    /// # Panics
    /// There is no environment with one of the indices.
    pub fn only(&mut self, environments: &[usize]) -> Selection<'_, P> {
        self.selected.fill(false);
        environments.iter().for_each(|&environment| self.selected[environment] = true);
        Selection(self)
    }

    /// The environments whose place in `mask` is true, to be stepped or run without the others.
    ///
    /// # Panics
    /// The mask has not one place for each environment.
    pub fn masked(&mut self, mask: &[bool]) -> Selection<'_, P> {
        self.selected.copy_from_slice(mask);
        Selection(self)
    }

    /// Advances every environment by `steps` time steps.
    ///
    /// # Errors
    /// As [`Batch::run`]; a failed environment stays where it failed.
    pub fn step(&mut self, steps: usize) -> Result<(), BatchError> {
        self.run(|env| (0..steps).try_for_each(|_| step(env.model, env.data)))
    }

    /// Calls `f` once for every environment, several at a time.
    ///
    /// # Errors
    /// Every environment for which `f` failed; it has been called for all of them.
    pub fn run<E: Send>(
        &mut self,
        f: impl Fn(Environment<'_, P>) -> Result<(), E> + Sync,
    ) -> Result<(), BatchError<E>> {
        self.selected.fill(true);
        self.run_selected(f)
    }

    fn run_selected<E: Send>(
        &mut self,
        f: impl Fn(Environment<'_, P>) -> Result<(), E> + Sync,
    ) -> Result<(), BatchError<E>> {
        let environments = self.models.iter().zip(&mut self.data).zip(&mut self.payloads);
        let selected = environments.zip(&self.selected).enumerate().filter(|(_, (_, selected))| **selected);
        let queue = Mutex::new(selected);
        let failures = Mutex::new(Vec::new());
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        let work = |scratch: &mut Scratch| {
            while let Some((index, (((model, data), payload), _))) = next() {
                std::mem::swap(scratch, &mut data.scratch);
                let result = f(Environment { index, model, data, payload });
                std::mem::swap(scratch, &mut data.scratch);
                if let Err(error) = result {
                    let mut failures = failures.lock().unwrap_or_else(PoisonError::into_inner);
                    failures.push(Failure { environment: index, error });
                }
            }
        };
        #[cfg(feature = "threads")]
        if let Some(pool) = &self.pool {
            use rayon::prelude::*;
            pool.install(|| self.workers.par_iter_mut().with_max_len(1).for_each(work));
        }
        // What no thread has taken: nothing, or all of it without threads.
        self.workers.iter_mut().take(1).for_each(work);
        let mut failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
        failures.sort_by_key(|failure: &Failure<E>| failure.environment);
        if failures.is_empty() { Ok(()) } else { Err(BatchError { failures }) }
    }
}

/// Some environments of a batch.
#[derive(Debug)]
pub struct Selection<'b, P>(&'b mut Batch<P>);

impl<P: Send> Selection<'_, P> {
    /// [`Batch::step`] of the selected environments.
    ///
    /// # Errors
    /// As [`Batch::step`].
    pub fn step(self, steps: usize) -> Result<(), BatchError> {
        self.0.run_selected(|env| (0..steps).try_for_each(|_| step(env.model, env.data)))
    }

    /// [`Batch::run`] of the selected environments.
    ///
    /// # Errors
    /// As [`Batch::run`].
    pub fn run<E: Send>(
        self,
        f: impl Fn(Environment<'_, P>) -> Result<(), E> + Sync,
    ) -> Result<(), BatchError<E>> {
        self.0.run_selected(f)
    }
}

#[cfg(feature = "threads")]
fn start_threads(threads: usize) -> Result<rayon::ThreadPool, ThreadsError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("batch-{i}"))
        .build()
        .map_err(|e| ThreadsError { threads, reason: e.to_string() })
}
