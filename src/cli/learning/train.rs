//! `train`: learn a policy, in a folder from which it can be resumed.

use super::starting::{Starting, begin, environment};
use crate::failure::Failure;
use crate::input::policy::failure;
use crate::interrupt::Interrupt;
use crate::terminal::{note, show};
use agents::run::{Row, Run};
use clap::{Args, ValueHint};
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Learn a policy from episodes of an environment
#[derive(Args)]
#[command(
    after_help = "A run is a folder. run.toml says what is trained and how: edit a copy and give it instead of ID. log.csv and \
log.jsonl have a row for each iteration; events.out.tfevents.robohive has the same numbers for TensorBoard (`tensorboard --logdir FOLDER`); \
checkpoint.safetensors is where the run resumes; policy.safetensors is what acts: `robohive run ID --policy FOLDER/policy.safetensors`.

The seed decides everything: the same run makes the same bits on any number of threads, and a run that was interrupted, by Ctrl-C or \
by the loss of the machine, and resumed by --resume ends as one that was not.

Algorithms: npg, the natural policy gradient (Kakade, 2001; Rajeswaran et al., 2017), with the networks, episodes and steps of \
MyoSuite's published runs; ppo, proximal policy optimisation (Schulman et al., 2017); sac, soft actor-critic (Haarnoja et al., 2018) \
with layer normalisation and returns of several steps; bc, behaviour cloning of a teacher; dagger, the same of a teacher who also says \
what to do in each state that the policy comes to (Ross et al., 2011); dapg, the natural policy gradient with demonstrations (Rajeswaran \
et al., 2018).

A teacher is a controller (`robohive run ID --controller list`) or a policy, a pickle of mjrl among them. Its successful episodes are kept in the folder, as \
demonstrations.safetensors, so that a run resumes without it; but dagger asks it again and again.

Examples:
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 2 --out elbow
  robohive train --resume elbow --iterations 3
  robohive train elbow/run.toml --seed 2 --out elbow2
  robohive train hive/FrankaReach-v0 --algo ppo --iterations 1 --out reach --quiet
  robohive train hive/myoElbowPose1D6MRandom-v0 --algo sac --iterations 1 --out soft --quiet
  robohive train hive/FrankaReach-v0 --algo bc --teacher reach --iterations 1 --out clone --quiet
  robohive train hive/FrankaReach-v0 --algo dagger --teacher reach --iterations 1 --out dagger"
)]
pub struct Train {
    /// Id of the environment, or the run.toml of a run to make again
    #[arg(value_name = "ID|CONFIG", required_unless_present = "resume")]
    what: Option<String>,
    /// What is trained, and how
    #[command(flatten)]
    starting: Starting,
    /// Seed of the run [default: 1, or what CONFIG says]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Iterations in all [default: 100, or what the run says]
    #[arg(long, value_name = "N")]
    iterations: Option<u64>,
    /// Folder of the run, new or empty [default: ID with the seed]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Resume the run in this folder
    #[arg(
        long,
        value_name = "FOLDER",
        value_hint = ValueHint::DirPath,
        conflicts_with_all = ["what", "algo", "teacher", "demonstrations", "demonstration_noise", "seed", "keep_every", "out"]
    )]
    resume: Option<PathBuf>,
    /// Threads; 0 for as many as there are cores. They make no difference to what is learnt
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(a: &Train) -> Result<(), Failure> {
    let (folder, mut run) = open(a)?;
    if let (Some(iterations), Some(_)) = (a.iterations, &a.resume) {
        run.extend(iterations).map_err(failure)?;
    }
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let bar = if a.quiet { ProgressBar::hidden() } else { progress(&run) };
    let mut last = None;
    while !run.is_finished() && interrupt.code().is_none() {
        let row = run.iterate().map_err(failure)?;
        bar.set_position(run.iterations());
        bar.set_message(message(&row));
        last = Some(row);
    }
    run.keep().map_err(failure)?;
    bar.finish_and_clear();
    show_end(&folder, &run, last);
    match interrupt.code().filter(|_| !run.is_finished()) {
        None => Ok(()),
        Some(code) => {
            let message = format!("interrupted; resume it by `robohive train --resume {}`", folder.display());
            Err(Failure { code, ..Failure::new(message) })
        }
    }
}

/// The run to make or to resume, and its folder.
fn open(a: &Train) -> Result<(PathBuf, Run), Failure> {
    if let Some(folder) = &a.resume {
        let config = Run::config_of(folder).map_err(failure)?;
        a.starting.check(&config)?;
        let env = environment(a.starting.making.clone(), &config)?;
        let run = Run::resume(folder, &env, a.threads).map_err(failure)?;
        return Ok((folder.clone(), run));
    }
    let what = a.what.as_deref().ok_or_else(|| Failure::usage("ID or CONFIG is needed"))?;
    let mut config = a.starting.config(what)?;
    config.seed = a.seed.unwrap_or(config.seed);
    config.iterations = a.iterations.unwrap_or(config.iterations);
    a.starting.check(&config)?;
    let name = format!("{}-seed{}", config.id.replace('/', "-"), config.seed);
    let folder = a.out.clone().unwrap_or_else(|| name.into());
    let env = environment(a.starting.making.clone(), &config)?;
    let run = begin(&folder, config, &env, a.threads, a.quiet)?;
    Ok((folder, run))
}

fn progress(run: &Run) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} iterations, {eta} left, {msg}");
    let bar = ProgressBar::new(run.config().iterations)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_position(run.iterations());
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

fn message(row: &Row) -> String {
    let speed =
        row.get("episodes") / row.get("iteration").max(1.0) * row.get("episode_length") / row.get("time");
    format!(
        "return {:.1}, success {:.0} %, {speed:.0} steps/s",
        row.get("stoc_pol_mean"),
        row.get("success_percentage")
    )
}

fn show_end(folder: &Path, run: &Run, last: Option<Row>) {
    show!("run          {}", folder.display());
    show!("iterations   {} of {}", run.iterations(), run.config().iterations);
    match last {
        None => note("nothing was left to do; --iterations asks for more"),
        Some(row) => {
            let time = HumanDuration(Duration::from_secs_f64(row.get("time")));
            show!("return       {:.2}, the last iteration's mean", row.get("stoc_pol_mean"));
            show!(
                "success      {:.0} % of its episodes, whose actions are drawn",
                row.get("success_percentage")
            );
            show!("samples      {}; an iteration took {time}", row.get("num_samples"));
        }
    }
    show!("policy       {}", run.policy().display());
}
