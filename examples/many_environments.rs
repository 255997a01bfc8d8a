//! A vector of environments: many of one id, stepped together.

use robohive::env::{Autoreset, Options};
use robohive::{Env, OwnModels, VecEnv};

/// Environments.
const COUNT: usize = 16;
/// Steps of each.
const STEPS: usize = 30;

/// Plays muscles at random on a number of threads; the sum of all rewards, and how many episodes ended.
fn play(threads: usize) -> Result<(f64, usize), Box<dyn std::error::Error>> {
    let options = Options::default().with_changes("max_episode_steps = 10".parse()?);
    let env = Env::make("hive/ElbowPose-v0", &OwnModels, &options)?;
    let mut envs = VecEnv::new(&env, COUNT, Autoreset::SameStep, threads)?;
    let mut draws = robohive::Generator::pcg64(7_u64);
    let mut actions = vec![0.0; COUNT * envs.action_len()];
    let (mut sum, mut ended) = (0.0, 0);
    // The environments are seeded with 1, 2, 3 and so on, so that each draws its own target.
    envs.reset(Some(1))?;
    let width = envs.observation_len();
    assert!(envs.observations()[..width] != envs.observations()[width..2 * width]);
    for _ in 0..STEPS {
        draws.fill_uniform(-1.0, 1.0, &mut actions)?;
        let observations = envs.step(&actions)?;
        assert_eq!(observations.len(), COUNT * width);
        for record in envs.records() {
            sum += record.reward;
            ended += usize::from(record.terminated || record.truncated);
        }
    }
    Ok((sum, ended))
}

/// Steps the environments under random actions.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (sum, ended) = play(1)?;
    assert_eq!(ended, COUNT * STEPS / 10, "every episode has ten steps, and the next begins by itself");
    let (again, _) = play(2)?;
    assert_eq!(sum.to_bits(), again.to_bits(), "the number of threads changes no bit");
    Ok(())
}
