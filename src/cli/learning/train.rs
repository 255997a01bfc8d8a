//! `train`: learn a policy, in a folder from which it can be resumed.

use super::teacher::{TeacherArguments, correct, teach};
use crate::failure::Failure;
use crate::input::library::Making;
use crate::input::solver::SolverArgument;
use crate::interrupt::Interrupt;
use crate::terminal::{note, show};
use agents::PolicyError;
use agents::learn::Settings;
use agents::run::{Config, Row, Run};
use clap::{Args, ValueEnum, ValueHint};
use env::{Compat, Env};
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Environments that each thread steps side by side: networks are faster on several rows.
const SIDE_BY_SIDE: usize = 16;

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

A teacher is a controller (`robohive run ID --controller list`) or a policy. Its successful episodes are kept in the folder, as \
demonstrations.safetensors, so that a run resumes without it; but dagger asks it again and again.

Examples:
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 2 --out elbow
  robohive train --resume elbow --iterations 3
  robohive train elbow/run.toml --seed 2 --out elbow2
  robohive train hive/FrankaReach-v0 --algo ppo --iterations 1 --out reach --quiet
  robohive train hive/myoElbowPose1D6MRandom-v0 --algo sac --iterations 1 --out soft --quiet
  robohive train hive/FrankaReach-v0 --algo bc --teacher reach --demonstrations 5 --iterations 1 --out clone
  robohive train hive/FrankaReach-v0 --algo dagger --teacher reach --demonstrations 2 --iterations 1 --out corrected --quiet"
)]
pub struct Train {
    /// Id of the environment, or the run.toml of a run to make again
    #[arg(value_name = "ID|CONFIG", required_unless_present = "resume", conflicts_with = "resume")]
    what: Option<String>,
    /// How environments are made
    #[command(flatten)]
    making: Making,
    /// How it is learnt [default: npg, or what CONFIG says]
    #[arg(long, value_name = "NAME", conflicts_with = "resume")]
    algo: Option<AlgorithmName>,
    /// Who shows how it is done
    #[command(flatten)]
    teacher: TeacherArguments,
    /// Seed of the run [default: 1, or what CONFIG says]
    #[arg(long, value_name = "SEED", conflicts_with = "resume")]
    seed: Option<u64>,
    /// Iterations in all [default: 100, or what the run says]
    #[arg(long, value_name = "N")]
    iterations: Option<u64>,
    /// Iterations from one checkpoint to the next [default: 10, or what CONFIG says]
    #[arg(long, value_name = "N", conflicts_with = "resume", value_parser = clap::value_parser!(u64).range(1..))]
    keep_every: Option<u64>,
    /// Folder of the run, new or empty [default: ID with the seed]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath, conflicts_with = "resume")]
    out: Option<PathBuf>,
    /// Resume the run in this folder
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    resume: Option<PathBuf>,
    /// Threads; 0 for as many as there are cores. They make no difference to what is learnt
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// Algorithms by name.
#[derive(Clone, Copy, ValueEnum)]
pub enum AlgorithmName {
    /// The natural policy gradient
    Npg,
    /// Proximal policy optimisation
    Ppo,
    /// Soft actor-critic: learns again and again from all it remembers, where steps are slow
    Sac,
    /// Behaviour cloning: only from demonstrations
    Bc,
    /// Behaviour cloning of a teacher who corrects the policy's own episodes (dataset aggregation)
    Dagger,
    /// The natural policy gradient with demonstrations
    Dapg,
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
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let sizes = [SIDE_BY_SIDE, if a.threads == 0 { cores } else { a.threads }];
    if let Some(folder) = &a.resume {
        let config = Run::config_of(folder).map_err(failure)?;
        let mut run = Run::resume(folder, &make(a, &config)?, sizes).map_err(failure)?;
        correct(&mut run)?;
        return Ok((folder.clone(), run));
    }
    let config = config(a)?;
    let name = format!("{}-seed{}", config.id.replace('/', "-"), config.seed);
    let folder = a.out.clone().unwrap_or_else(|| name.into());
    let env = make(a, &config)?;
    // Demonstrations come first: a teacher that fails leaves no folder.
    let demonstrations = teach(&config, &env, a.quiet)?;
    let mut run = Run::create(&folder, config, &env, sizes).map_err(failure)?;
    if let Some(demonstrations) = demonstrations {
        run.teach(demonstrations).map_err(failure)?;
        correct(&mut run)?;
    }
    Ok((folder, run))
}

/// What is to be trained, and how.
fn config(a: &Train) -> Result<Config, Failure> {
    let what = a.what.as_deref().ok_or_else(|| Failure::usage("ID or CONFIG is needed"))?;
    let mut config = if what.ends_with(".toml") {
        Config::read(Path::new(what)).map_err(failure)?
    } else {
        Config {
            id: what.into(),
            seed: 1,
            iterations: 100,
            keep_every: 10,
            compat: Some(a.making.compat.to_string()),
            solver: Some(a.making.solver.name()),
            environment: a.making.changes()?,
            teacher: None,
            learning: Settings::npg(),
        }
    };
    match a.algo {
        None => {}
        Some(AlgorithmName::Npg) => config.learning = Settings::npg(),
        Some(AlgorithmName::Ppo) => config.learning = Settings::ppo(),
        Some(AlgorithmName::Bc) => config.learning = Settings::cloning(),
        Some(AlgorithmName::Dagger) => config.learning = Settings::dagger(),
        Some(AlgorithmName::Sac) => config.learning = Settings::sac(),
        Some(AlgorithmName::Dapg) => config.learning = Settings::dapg(),
    }
    config.teacher = a.teacher.given(config.teacher)?;
    config.seed = a.seed.unwrap_or(config.seed);
    config.iterations = a.iterations.unwrap_or(config.iterations);
    config.keep_every = a.keep_every.unwrap_or(config.keep_every);
    Ok(config)
}

/// The environment of a configuration, which says how it is made; what is given beside it must be the same.
fn make(a: &Train, config: &Config) -> Result<Env, Failure> {
    let making = made(a.making.clone(), config)?;
    let (given, none) = (making.changes()?, env::Arguments::default());
    for (option, differs) in [
        ("--set", given != none && given != config.environment),
        ("--compat", ![Compat::Fixed, making.compat].contains(&a.making.compat)),
        ("--solver", !a.making.solver.is_own() && making.solver.is_own()),
    ] {
        if differs {
            let message =
                format!("{option} belongs to a run from its beginning: change it in a copy of run.toml");
            return Err(Failure::usage(message));
        }
    }
    environment(making, config)
}

/// How a configuration says that its environment is made.
fn made(mut making: Making, config: &Config) -> Result<Making, Failure> {
    if let Some(compat) = &config.compat {
        making.compat = compat.parse().map_err(Failure::usage)?;
    }
    if let Some(solver) = &config.solver {
        making.solver = SolverArgument::named(solver)?;
    }
    Ok(making)
}

/// The environment of a configuration.
///
/// # Errors
/// There is none of its id, or it cannot be made.
pub fn environment(making: Making, config: &Config) -> Result<Env, Failure> {
    let making = made(making, config)?;
    let library = making.assets()?;
    let options = making.options()?.with_changes(config.environment.clone());
    Env::make(&config.id, &library, &options).map_err(Failure::usage)
}

/// What was wrong: with what was given, or with what happened.
pub fn failure(error: PolicyError) -> Failure {
    match error {
        PolicyError::Env(_) | PolicyError::Reward { .. } => Failure::new(error),
        error => Failure::usage(error),
    }
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
