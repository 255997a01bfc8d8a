//! Batched stepping: many simulations side by side on a pool of threads.
//!
//! Every environment has its own [`Data`]; the [`Model`] is one for all until an environment edits its own, which
//! copies it. Working memory belongs to the threads, not to the environments. An environment reads nothing of
//! another, so the result does not depend on the number of threads, to the last bit.
//!
//! ```
//! use robohive_physics::{Batch, Model, step};
//!
//! fn example(model: Model) -> Result<(), Box<dyn std::error::Error>> {
//!     let mut batch = Batch::new(model.into(), 64, 2)?;
//!     batch.edit_model(3, |m| m.opt.gravity = [0.0, 0.0, -1.6])?;
//!     batch.step(10)?;
//!     batch.run(|environment, model, data| {
//!         data.state.ctrl.fill(0.1 * environment as f64);
//!         step(model, data)
//!     })?;
//!     println!("{:?}", batch.data()[3].state.qpos);
//!     Ok(())
//! }
//! ```

use crate::data::{Data, Scratch};
use crate::model::{Arrays, EditError, Model};
use crate::pipeline::forward::{StepError, step};
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Environments that are stepped together.
#[derive(Debug)]
pub struct Batch {
    models: Vec<Arc<Model>>,
    data: Vec<Data>,
    /// Working memory, one a thread; that of the environments stays empty.
    workers: Vec<Scratch>,
    #[cfg(feature = "threads")]
    pool: Option<rayon::ThreadPool>,
}

/// An environment of a batch could not be stepped.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchError {
    /// Index of the environment.
    pub environment: usize,
    /// What was wrong with it.
    pub error: StepError,
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "environment {}: {}", self.environment, self.error)
    }
}

impl std::error::Error for BatchError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.error)
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
    pub fn new(model: Arc<Model>, environments: usize, threads: usize) -> Result<Self, ThreadsError> {
        let data = vec![Data::new(&model); environments];
        let models = vec![model; environments];
        #[cfg(feature = "threads")]
        return Ok(Batch {
            models,
            data,
            workers: vec![Scratch::default(); threads.max(1)],
            pool: if threads > 1 { Some(start_threads(threads)?) } else { None },
        });
        #[cfg(not(feature = "threads"))]
        {
            let _ = threads;
            Ok(Batch { models, data, workers: vec![Scratch::default()] })
        }
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
        change: impl FnOnce(&mut Arrays),
    ) -> Result<(), EditError> {
        self.models[environment] = Arc::new(self.models[environment].edited(change)?);
        Ok(())
    }

    /// Advances every environment by `steps` time steps.
    ///
    /// # Errors
    /// As [`Batch::run`].
    pub fn step(&mut self, steps: usize) -> Result<(), BatchError> {
        self.run(|_, model, data| (0..steps).try_for_each(|_| step(model, data)))
    }

    /// Calls `f(environment, model, data)` once for every environment, several at a time.
    ///
    /// # Errors
    /// The failed environment of the least index; `f` has been called for all the others too.
    pub fn run<F>(&mut self, f: F) -> Result<(), BatchError>
    where
        F: Fn(usize, &Model, &mut Data) -> Result<(), StepError> + Sync,
    {
        let queue = Mutex::new(self.models.iter().zip(&mut self.data).enumerate());
        let failed = Mutex::new(None::<BatchError>);
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        let work = |scratch: &mut Scratch| {
            while let Some((environment, (model, data))) = next() {
                std::mem::swap(scratch, &mut data.scratch);
                let result = f(environment, model, data);
                std::mem::swap(scratch, &mut data.scratch);
                if let Err(error) = result {
                    keep_first(&failed, BatchError { environment, error });
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
        failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
    }
}

/// Keeps the error of the least environment, whatever the order in which they come.
fn keep_first(failed: &Mutex<Option<BatchError>>, error: BatchError) {
    let mut kept = failed.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.as_ref().is_none_or(|k| error.environment < k.environment) {
        *kept = Some(error);
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
