//! `evaluate`: how often a policy succeeds, and how often doing nothing does.

use super::playing::{Playing, interval};
use crate::failure::Failure;
use crate::input::library::Making;
use crate::input::policy::policy;
use crate::terminal::{show, show_json};
use agents::Policy;
use clap::{Args, ValueHint};
use env::Success;
use env::episode::{Evaluation, evaluate};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

/// Say how often a policy succeeds, with its 95 % interval, beside zero and random actions
#[derive(Args)]
#[command(
    after_help = "Episode k is reset with SEED + k, and the policy gives its mean action. Zero and random actions play the same \
episodes: several tasks are solved by standing still, so that a success says something only beside theirs.

The interval is Wilson's for a share of episodes; where a task counts a share of solved steps, it is left out.

Examples:
  robohive evaluate best hive/myoElbowPose1D6MRandom-v0
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 1 --out trained
  robohive evaluate trained/policy.safetensors --episodes 20
  robohive evaluate trained/policy.safetensors --episodes 20 --json"
)]
pub struct Evaluate {
    /// A policy that `train` wrote, or a pickle of mjrl; best, the one that is shipped for ID
    #[arg(value_name = "POLICY", value_hint = ValueHint::FilePath)]
    policy: String,
    /// Id of the environment [default: what the policy was trained on]
    #[arg(value_name = "ID")]
    id: Option<String>,
    /// How environments are made
    #[command(flatten)]
    making: Making,
    /// Which episodes are played
    #[command(flatten)]
    playing: Playing,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(a: &Evaluate) -> Result<(), Failure> {
    let given = a.id.as_deref();
    let policy = policy(&a.policy, given)?;
    let trained = match &policy {
        Policy::Trained(trained) => Some(trained.card().id.clone()),
        _ => None,
    };
    let id = given.map(str::to_owned).or(trained).ok_or_else(|| {
        Failure::usage(format!("{} does not say what it was trained on: give an ID after it", a.policy))
    })?;
    let env = a.making.make(&id)?;
    let names = [a.policy.clone(), "zero".into(), "random".into()];
    let bar = progress(a, names.len() as u64);
    let mut rows = Vec::new();
    for (name, policy) in names.into_iter().zip([policy, Policy::Zero, Policy::random(0)]) {
        let episodes = a.playing.play(&env, &policy, &bar)?;
        rows.push((name, evaluate(&episodes, env.success())));
    }
    bar.finish_and_clear();
    report(a, &id, env.success(), &rows);
    Ok(())
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
                    "interval": counts.then(|| interval(found.success_percentage, a.playing.episodes)),
                    "return": found.reward,
                    "rwd_dense": found.rwd_dense,
                    "rwd_sparse": found.rwd_sparse,
                })
            })
            .collect();
        return show_json(
            &json!({ "id": id, "episodes": a.playing.episodes, "seed": a.playing.seed, "rows": rows }),
        );
    }
    show!("{id}, {} episodes from seed {}", a.playing.episodes, a.playing.seed);
    show!("{:>9}  {:>15}  {:>10}  policy", "success", "95 % interval", "return");
    for (name, found) in rows {
        let [low, high] = interval(found.success_percentage, a.playing.episodes);
        let interval = if counts { format!("{low:.1} to {high:.1} %") } else { "-".into() };
        show!("{:>7.1} %  {interval:>15}  {:>10.2}  {name}", found.success_percentage, found.reward);
    }
}

fn progress(a: &Evaluate, policies: u64) -> ProgressBar {
    if a.quiet || a.json {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} episodes, {eta} left");
    ProgressBar::new(policies * u64::from(a.playing.episodes))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
