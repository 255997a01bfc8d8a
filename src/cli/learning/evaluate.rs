//! `evaluate`: how often a policy succeeds, and how often doing nothing does.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::input::policy::policy;
use crate::terminal::{show, show_json};
use agents::Policy;
use clap::{Args, ValueHint};
use env::episode::{Evaluation, Summary, evaluate};
use env::{Env, Success};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::sync::atomic::{AtomicU32, Ordering};

/// Quantile of the normal distribution for 95 % on both sides.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// Say how often a policy succeeds, with its 95 % interval, beside zero and random actions
#[derive(Args)]
#[command(
    after_help = "Episode k is reset with SEED + k, and the policy gives its mean action. Zero and random actions play the same \
episodes: several tasks are solved by standing still, so that a success says something only beside theirs.

The interval is Wilson's for a share of episodes; where a task counts a share of solved steps, it is left out.

Examples:
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 1 --out trained
  robohive evaluate trained/policy.safetensors --episodes 20
  robohive evaluate trained/policy.safetensors --episodes 20 --json"
)]
pub struct Evaluate {
    /// A policy that `train` wrote, or a pickle of mjrl
    #[arg(value_name = "POLICY", value_hint = ValueHint::FilePath)]
    policy: String,
    /// Id of the environment [default: what the policy was trained on]
    #[arg(value_name = "ID")]
    id: Option<String>,
    /// How environments are made
    #[command(flatten)]
    making: Making,
    /// Episodes of each
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..))]
    episodes: u32,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Threads; 0 for as many as there are cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(a: &Evaluate) -> Result<(), Failure> {
    let policy = policy(&a.policy)?;
    let trained = match &policy {
        Policy::Trained(trained) => Some(trained.card().id.clone()),
        _ => None,
    };
    let id = a.id.clone().or(trained).ok_or_else(|| {
        Failure::usage(format!("{} does not say what it was trained on: give an ID after it", a.policy))
    })?;
    let env = a.making.make(&id)?;
    let names = [a.policy.clone(), "zero".into(), "random".into()];
    let bar = progress(a, names.len() as u64);
    let mut rows = Vec::new();
    for (name, policy) in names.into_iter().zip([policy, Policy::Zero, Policy::random(0)]) {
        let episodes = play(a, &env, &policy, &bar)?;
        rows.push((name, evaluate(&episodes, env.success())));
    }
    bar.finish_and_clear();
    report(a, &id, env.success(), &rows);
    Ok(())
}

/// Plays the episodes, on several threads.
fn play(a: &Evaluate, env: &Env, policy: &Policy, bar: &ProgressBar) -> Result<Vec<Summary>, Failure> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if a.threads == 0 { cores } else { a.threads }.min(a.episodes as usize);
    let next = AtomicU32::new(0);
    let work = |mut env: Env| -> Result<Vec<(u32, Summary)>, Failure> {
        let (mut played, mut action) = (Vec::new(), vec![0.0; env.action_len()]);
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= a.episodes {
                return Ok(played);
            }
            let seed = a.seed.wrapping_add(u64::from(index));
            played.push((index, episode(&mut env, policy.for_episode(seed), seed, &mut action)?));
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

fn episode(env: &mut Env, mut policy: Policy, seed: u64, action: &mut [f64]) -> Result<Summary, Failure> {
    env.reset(Some(seed)).map_err(Failure::new)?;
    let mut summary = Summary::default();
    while !(summary.terminated || summary.truncated) {
        policy.action(env, action).map_err(Failure::usage)?;
        let step = env.step(action).map_err(Failure::new)?;
        summary.add(env, &step);
    }
    Ok(summary)
}

/// Wilson's interval of a share of `count` episodes \[%\] (Wilson, 1927).
fn interval(percentage: f64, count: u32) -> [f64; 2] {
    let (share, count, square) = (percentage / 100.0, f64::from(count), QUANTILE * QUANTILE);
    let middle = (share + square / (2.0 * count)) / (1.0 + square / count);
    let half = QUANTILE / (1.0 + square / count)
        * (share * (1.0 - share) / count + square / (4.0 * count * count)).sqrt();
    [(middle - half).max(0.0), (middle + half).min(1.0)].map(|share| 100.0 * share)
}

fn report(a: &Evaluate, id: &str, rule: Success, rows: &[(String, Evaluation)]) {
    let counts = matches!(rule, Success::MoreThan(_));
    if a.json {
        let rows: Vec<_> = rows
            .iter()
            .map(|(name, found)| {
                json!({
                    "policy": name,
                    "success_percentage": found.success_percentage,
                    "interval": counts.then(|| interval(found.success_percentage, a.episodes)),
                    "return": found.reward,
                    "rwd_dense": found.rwd_dense,
                    "rwd_sparse": found.rwd_sparse,
                })
            })
            .collect();
        return show_json(&json!({ "id": id, "episodes": a.episodes, "seed": a.seed, "rows": rows }));
    }
    show!("{id}, {} episodes from seed {}", a.episodes, a.seed);
    show!("{:>9}  {:>15}  {:>10}  policy", "success", "95 % interval", "return");
    for (name, found) in rows {
        let [low, high] = interval(found.success_percentage, a.episodes);
        let interval = if counts { format!("{low:.1} to {high:.1} %") } else { "-".into() };
        show!("{:>7.1} %  {interval:>15}  {:>10.2}  {name}", found.success_percentage, found.reward);
    }
}

fn progress(a: &Evaluate, policies: u64) -> ProgressBar {
    if a.quiet || a.json {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} episodes, {eta} left");
    ProgressBar::new(policies * u64::from(a.episodes))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Brown, Cai and DasGupta (2001), section 3.1.1, give the formula; its ends for 0 and for all are n/(n + z²) and its complement.
    #[test]
    fn intervals_hold_the_share_and_are_not_empty_at_the_ends() {
        let [low, high] = interval(0.0, 20);
        assert!(low == 0.0 && (high - 100.0 * 3.841_458_820_694_124 / 23.841_458_820_694_124).abs() < 1e-9);
        let [low, high] = interval(100.0, 200);
        assert!((low - 100.0 * 200.0 / 203.841_458_820_694_124).abs() < 1e-9 && high > 99.999);
        let [low, high] = interval(50.0, 100);
        assert!((low + high - 100.0).abs() < 1e-9 && (low - 40.38).abs() < 0.01, "{low} {high}");
    }
}
