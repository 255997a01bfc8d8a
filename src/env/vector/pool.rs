//! Threads that carry out one piece of work for each environment of a batch.

use crate::error::EnvError;

/// A number of threads. They start with the first batch that needs them; one thread is the caller's.
pub struct Pool {
    #[cfg(feature = "threads")]
    threads: usize,
    /// With the process that started them: a fork has none of its parent's threads.
    #[cfg(feature = "threads")]
    started: Option<(u32, rayon::ThreadPool)>,
}

impl Pool {
    /// A pool of `threads` threads; 0 for one a core.
    #[cfg(feature = "threads")]
    pub fn new(threads: usize) -> Self {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        Pool { threads: if threads == 0 { cores() } else { threads }, started: None }
    }

    /// The caller's thread alone.
    #[cfg(not(feature = "threads"))]
    pub fn new(_: usize) -> Self {
        Pool {}
    }

    /// How many threads there are.
    #[cfg(feature = "threads")]
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Calls `each` with every piece of work, in any order.
    ///
    /// # Errors
    /// The threads cannot be started.
    #[cfg(feature = "threads")]
    pub fn each<W: Send>(&mut self, work: Vec<W>, each: impl Fn(W) + Sync) -> Result<(), EnvError> {
        use rayon::prelude::*;
        if self.threads == 1 || work.len() < 2 {
            work.into_iter().for_each(each);
            return Ok(());
        }
        self.pool()?.install(|| work.into_par_iter().with_max_len(1).for_each(&each));
        Ok(())
    }

    /// Calls `each` with every piece of work.
    ///
    /// # Errors
    /// None.
    #[cfg(not(feature = "threads"))]
    pub fn each<W: Send>(&mut self, work: Vec<W>, each: impl Fn(W) + Sync) -> Result<(), EnvError> {
        work.into_iter().for_each(each);
        Ok(())
    }

    #[cfg(feature = "threads")]
    fn pool(&mut self) -> Result<&rayon::ThreadPool, EnvError> {
        let process = std::process::id();
        if let Some((owner, pool)) = self.started.take() {
            if owner == process {
                return Ok(&self.started.insert((owner, pool)).1);
            }
            // Its threads are the parent's; ending it here would wait for them.
            std::mem::forget(pool);
        }
        let builder = rayon::ThreadPoolBuilder::new().num_threads(self.threads);
        let refused = |error: rayon::ThreadPoolBuildError| EnvError::Threads { message: error.to_string() };
        let pool = builder.thread_name(|k| format!("robohive-{k}")).build().map_err(refused)?;
        Ok(&self.started.insert((process, pool)).1)
    }
}
