//! A task solved without learning: a controller sees the whole environment and acts.

use robohive::control::{make, serving};
use robohive::env::Options;
use robohive::{Env, OwnModels};

/// Episodes played.
const EPISODES: u64 = 5;

/// Plays the episodes.
///
/// # Errors
/// An environment or a controller refuses.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut env = Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default())?;
    // Those that serve the id, the best first.
    let name = serving(env.spec()).next().ok_or("no controller serves the id")?.name;
    let mut controller = make(name, &env)?;
    let mut action = vec![0.0; env.action_len()];
    let mut solved = 0;
    for seed in 0..EPISODES {
        env.reset(Some(seed))?;
        controller.reset(&env, seed)?;
        loop {
            controller.act(&env, &mut action)?;
            let step = env.step(&action)?;
            if env.verdict().solved || step.truncated {
                break;
            }
        }
        solved += u64::from(env.verdict().solved);
    }
    println!("{name} solves {solved} of {EPISODES} episodes");
    assert_eq!(solved, EPISODES);
    Ok(())
}
