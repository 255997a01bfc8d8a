//! How fast a batch of environments steps.

use crate::failure::Failure;
use env::{Autoreset, Env, Rng, VecEnv};
use std::time::Instant;

/// Steps per second of `count` environments on a number of threads.
pub fn batch_speed(env: &Env, count: usize, threads: usize, seconds: f64) -> Result<f64, Failure> {
    let mut envs = VecEnv::new(env, count, Autoreset::NextStep, threads).map_err(Failure::new)?;
    let mut rng = Rng::pcg64(1_u64);
    let mut actions = vec![0.0; count * env.action_len()];
    envs.reset(Some(0)).map_err(Failure::new)?;
    let (began, mut steps) = (Instant::now(), 0);
    while began.elapsed().as_secs_f64() < seconds {
        for action in actions.chunks_exact_mut(env.action_len()) {
            env.random_action(&mut rng, action).map_err(Failure::new)?;
        }
        envs.step(&actions).map_err(Failure::new)?;
        steps += count;
    }
    Ok(steps as f64 / began.elapsed().as_secs_f64())
}
