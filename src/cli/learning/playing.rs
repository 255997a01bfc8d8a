//! Episodes that say how good a policy is: the same ones for every policy.

use crate::failure::Failure;
use crate::input::policy::failure;
use agents::Policy;
use agents::statistics::wilson;
use clap::Args;
use env::Env;
use env::episode::Summary;
use indicatif::ProgressBar;
use std::sync::atomic::{AtomicU32, Ordering};

/// Which episodes are played, and by how many threads.
#[derive(Args)]
pub struct Playing {
    /// Episodes of each policy
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..))]
    pub episodes: u32,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
    /// Threads; 0 for as many as there are cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

impl Playing {
    /// Plays the episodes, on several threads.
    ///
    /// # Errors
    /// The policy is one for another environment; the environment fails.
    pub fn play(&self, env: &Env, policy: &Policy, bar: &ProgressBar) -> Result<Vec<Summary>, Failure> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = if self.threads == 0 { cores } else { self.threads }.min(self.episodes as usize);
        let next = AtomicU32::new(0);
        let work = |mut env: Env| -> Result<Vec<(u32, Summary)>, Failure> {
            let mut played = Vec::new();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= self.episodes {
                    return Ok(played);
                }
                let seed = self.seed.wrapping_add(u64::from(index));
                played.push((index, policy.play(&mut env, seed).map_err(failure)?));
                bar.inc(1);
            }
        };
        let envs = (0..threads).map(|_| env.fork().map_err(Failure::new)).collect::<Result<Vec<_>, _>>()?;
        let parts: Vec<_> = std::thread::scope(|scope| {
            let running: Vec<_> = envs.into_iter().map(|env| scope.spawn(|| work(env))).collect();
            running.into_iter().map(|thread| thread.join().expect("a panic ends the command")).collect()
        });
        let mut episodes = parts.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        episodes.sort_unstable_by_key(|(index, _)| *index);
        Ok(episodes.into_iter().map(|(_, summary)| summary).collect())
    }
}

/// The 95 % interval of a share of `count` episodes \[%\].
pub fn interval(percentage: f64, count: u32) -> [f64; 2] {
    wilson(percentage / 100.0, count).map(|share| 100.0 * share)
}
