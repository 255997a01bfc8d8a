//! `run`: play episodes of an environment.

use crate::Failure;
use crate::library::Source;
use crate::terminal::{show, show_json};
use clap::Args;
use env::episode::{Summary, evaluate};
use env::{Env, Rng};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::time::Instant;

/// Play episodes of an environment and print returns, success and speed
#[derive(Args)]
#[command(
    after_help = "The episode of index k is seeded with SEED + k, so every episode can be played again by itself.

Examples:
  robohive run hive/FrankaReach-v0
  robohive run hive/FrankaReach-v0 --policy zero --episodes 20 --seed 7
  robohive run hive/FrankaReach-v0 --set max_episode_steps=20 --json"
)]
pub struct Run {
    /// The environment
    #[command(flatten)]
    source: Source,
    /// What acts: random or zero
    #[arg(long, value_name = "POLICY", default_value = "random")]
    policy: String,
    /// Episodes to play
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
    episodes: u32,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// What acts.
enum Policy {
    /// Every component uniform within its bounds.
    Random,
    /// Nothing but zeros.
    Zero,
}

impl Policy {
    fn open(name: &str) -> Result<Self, Failure> {
        match name {
            "random" => Ok(Policy::Random),
            "zero" => Ok(Policy::Zero),
            _ => Err(Failure::usage(format!("--policy is random or zero, not {name:?}"))),
        }
    }

    fn act(&self, env: &Env, rng: &mut Rng, action: &mut [f64]) -> Result<(), Failure> {
        match self {
            Policy::Random => env.random_action(rng, action).map_err(Failure::new),
            Policy::Zero => {
                action.fill(0.0);
                Ok(())
            }
        }
    }
}

/// Runs the command.
pub fn run(a: &Run) -> Result<(), Failure> {
    let policy = Policy::open(&a.policy)?;
    let mut env = a.source.make()?;
    let bar = if a.quiet || a.json { ProgressBar::hidden() } else { progress(a.episodes) };
    let mut episodes = Vec::new();
    let began = Instant::now();
    for index in 0..a.episodes {
        let episode = play(&mut env, &policy, a.seed.wrapping_add(u64::from(index)))?;
        bar.set_message(format!("return {:.2}, {} solved", episode.reward, episode.solved));
        bar.inc(1);
        episodes.push(episode);
    }
    let seconds = began.elapsed().as_secs_f64();
    bar.finish_and_clear();
    show_result(a, &env, &episodes, seconds);
    Ok(())
}

/// Plays one episode.
fn play(env: &mut Env, policy: &Policy, seed: u64) -> Result<Summary, Failure> {
    let mut rng = Rng::pcg64(seed);
    let mut action = vec![0.0; env.action_len()];
    let mut episode = Summary::default();
    env.reset(Some(seed)).map_err(Failure::new)?;
    while !episode.terminated && !episode.truncated {
        policy.act(env, &mut rng, &mut action)?;
        let step = env.step(&action).map_err(Failure::new)?;
        episode.add(env, &step);
        if let Some(fault) = &step.fault {
            crate::terminal::note(&format!("seed {seed}, step {}: {fault}", episode.steps));
        }
    }
    Ok(episode)
}

fn show_result(a: &Run, env: &Env, episodes: &[Summary], seconds: f64) {
    let result = evaluate(episodes, env.success());
    let steps: usize = episodes.iter().map(|episode| episode.steps).sum();
    let faults = episodes.iter().filter(|episode| episode.faulty).count();
    let speed = steps as f64 / seconds.max(1e-9);
    let returns = || episodes.iter().map(|episode| episode.reward);
    if a.json {
        show_json(&json!({
            "id": a.source.id, "policy": a.policy, "seed": a.seed, "episodes": episodes.len(), "steps": steps,
            "success_percentage": result.success_percentage, "return": result.reward, "rwd_dense": result.rwd_dense,
            "rwd_sparse": result.rwd_sparse, "returns": returns().collect::<Vec<_>>(), "faults": faults,
            "steps_per_second": speed,
        }));
        return;
    }
    let (low, high) =
        returns().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    show!("{}: {} episodes, {steps} steps, {} policy", a.source.id, episodes.len(), a.policy);
    show!("success      {:.1} %", result.success_percentage);
    show!("return       {:.3} (from {low:.3} to {high:.3})", result.reward);
    show!("sparse       {:.4} a step", result.rwd_sparse);
    let realtime = speed * env.dt();
    show!("speed        {speed:.0} env steps a second, {realtime:.1} times real time");
    if faults > 0 {
        show!("faults       {faults} episodes ended with a step that physics refused");
    }
}

fn progress(episodes: u32) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} episodes, {eta} left, {msg}");
    ProgressBar::new(u64::from(episodes)).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
