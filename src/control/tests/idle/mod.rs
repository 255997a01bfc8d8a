//! Episodes in which nothing is done.

use env::{Env, Options, OwnModels};

/// Whether zero actions solve the episode in as many steps as `actions`, of an episode that was played, took.
pub fn solved_by_nothing(id: &str, seed: u64, actions: &[f64]) -> bool {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let nothing = vec![0.0; env.action_len()];
    env.reset(Some(seed)).unwrap();
    (0..actions.len() / nothing.len()).any(|_| {
        env.step(&nothing).unwrap();
        env.verdict().solved
    })
}
