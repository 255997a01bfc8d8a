//! `data replay`: the actions of a recording, played again.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::recordings::open::open;
use crate::terminal::{note, show, show_json};
use clap::{Args, ValueHint};
use dataset::trace::TraceReader;
use env::{Compat, Env, Options};
use record::{Column, Description, Recorded};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Replay the actions of a recording and say how far it ends from what was recorded
#[derive(Args)]
#[command(
    after_help = "A trial starts from the reset with its recorded seed, where it has one, which also restores what resets \
change in the model; what it drew by physics_randomization and visual_randomization \
comes back where the reset drew something else; then its \
first recorded state is set, unless the reset gave it already, to the recorded precision. \
Its actions follow. For each trial there is the distance between the last recorded state and the replayed one, \
|qpos| [rad, m] and |qvel| [rad/s, m/s], and over all rows the greatest difference of an observation and of the reward; \
a histogram counts trials by |qpos|. A recording in full precision, made by this program, is replayed exactly.

Recordings of RoboHive itself have no attributes: name the ID, and with --seed what env.seed() was given, so that the \
resets draw shapes and masses that the recorded states do not hold. Their default precision, float16, is too coarse to repeat \
a motion in contact; its Trace keeps all bits after close(f_res=numpy.float64).

RoboSet's layout holds the joints of arm and gripper: they are set before the actions and compared at the end.

Examples:
  robohive run hive/FrankaReach-v0 --record reach.h5
  robohive data replay reach.h5
  robohive data replay reach.h5 --trials 0-2,5 --json"
)]
pub struct Replay {
    /// HDF5 file or numpy archive; - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Environment [default: the one that the recording names]
    id: Option<String>,
    /// Trials to replay, counted from 0 [default: all]
    #[arg(long, value_name = "LIST", value_parser = parse_list)]
    trials: Option<Places>,
    /// Seed that the recorder of trials without one gave the environment before the first of them
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Whose behaviour: `fixed` or `robohive-0.7` [default: what the recording names, else that of RoboHive 0.7]
    #[arg(long, value_name = "VERSION")]
    compat: Option<Compat>,
    /// Change a setting beside those that the recording names; VALUE is TOML, or text
    #[arg(long = "set", value_name = "SETTING=VALUE")]
    settings: Vec<String>,
    /// Folder with RoboHive's envs and simhive, instead of the imported assets
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    assets: Option<PathBuf>,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
}

/// Ranges of trials, both ends included.
#[derive(Clone)]
struct Places(Vec<[usize; 2]>);

impl Places {
    fn hold(&self, number: usize) -> bool {
        self.0.iter().any(|[low, high]| (*low..=*high).contains(&number))
    }
}

fn parse_list(text: &str) -> Result<Places, String> {
    let range = |part: &str| {
        let (low, high) = part.split_once('-').unwrap_or((part, part));
        Some([low.parse().ok()?, high.parse().ok()?]).filter(|[low, high]| low <= high)
    };
    let ranges: Option<_> = text.split(',').map(range).collect();
    ranges.map(Places).ok_or_else(|| format!("{text:?} is no list such as 0-2,5"))
}

/// Runs the command.
pub fn run(a: &Replay) -> Result<(), Failure> {
    let trace = open(&a.file)?;
    check_trials(a, &trace)?;
    let (id, mut env) = make(a, &trace)?;
    let mut outcomes = Vec::new();
    for (number, name) in trace.trials().iter().enumerate() {
        let seed = a.seed.filter(|_| number == 0);
        if a.trials.as_ref().is_none_or(|places| places.hold(number)) {
            let trial = Recorded::read(&trace, name).map_err(Failure::usage)?;
            outcomes.push(replay(&mut env, name, &trial, a.seed.is_some(), seed)?);
        } else if a.seed.is_some() {
            // Its reset draws, too.
            env.reset(seed).map_err(Failure::new)?;
        }
    }
    if a.json {
        show_json(&json!({ "id": id, "trials": outcomes.iter().map(Outcome::json).collect::<Vec<_>>() }));
    } else {
        show_table(&id, &outcomes);
    }
    Ok(())
}

/// Refuses trials that the recording does not have.
fn check_trials(a: &Replay, trace: &TraceReader) -> Result<(), Failure> {
    let count = trace.trials().len();
    let ranges = a.trials.iter().flat_map(|places| &places.0);
    match ranges.map(|[_, high]| *high).find(|high| *high >= count) {
        None => Ok(()),
        Some(high) => {
            let path = trace.path().display();
            Err(Failure::usage(format!("{path} has {count} trials, none of number {high}")))
        }
    }
}

/// The environment that the arguments name, or else the recording.
fn make(a: &Replay, trace: &TraceReader) -> Result<(String, Env), Failure> {
    let described = Description::of(trace, a.id.as_deref()).map_err(Failure::usage)?;
    let compat = a.compat.unwrap_or(described.compat);
    let making = Making {
        settings: a.settings.clone(),
        compat,
        assets: a.assets.clone(),
        cache: None,
        solver: Default::default(),
    };
    let mut changes = described.settings;
    changes.extend(making.changes()?);
    let options = Options::default().with_compat(compat).with_changes(changes);
    let env = Env::make(&described.id, &making.assets()?, &options).map_err(Failure::usage)?;
    Ok((described.id, env))
}

/// What came of a trial.
struct Outcome {
    trial: String,
    steps: usize,
    /// Whether the first state comes from a seeded reset, with nothing set.
    from_seed: bool,
    /// Distance between the last states, where there are two.
    qpos: Option<f64>,
    qvel: Option<f64>,
    /// Greatest difference over all rows.
    observations: Option<f64>,
    rewards: Option<f64>,
    fault: Option<String>,
}

impl Outcome {
    fn json(&self) -> Value {
        json!({
            "name": self.trial, "steps": self.steps, "from_seed": self.from_seed, "qpos": self.qpos, "qvel": self.qvel,
            "observations": self.observations, "rewards": self.rewards, "fault": self.fault,
        })
    }
}

/// Plays a trial again.
///
/// It starts from the reset with its own seed, or with `seed`; `drawn` says that this reset draws what the recorded one drew.
fn replay(
    env: &mut Env,
    name: &str,
    trial: &Recorded,
    drawn: bool,
    seed: Option<u64>,
) -> Result<Outcome, Failure> {
    let fail =
        |step: usize, error: &dyn std::fmt::Display| Failure::usage(format!("{name}, step {step}: {error}"));
    let drawn = drawn || trial.seed.is_some();
    if !drawn && trial.part("qpos").is_none() {
        note(&format!("{name} holds neither a seed nor a state: it starts from a reset with seed 0"));
    }
    env.reset(trial.seed.or(if drawn { seed } else { Some(0) })).map_err(Failure::new)?;
    let redrawn = trial.restore_drawn(env).map_err(|error| fail(0, &error))?;
    let start = trial.start(env);
    if let Some(world) = &start {
        env.set_world(world).map_err(|error| fail(0, &error))?;
    }
    let mut rows = Greatest::default();
    rows.compare(env, trial, 0);
    let (mut steps, mut fault) = (0, None);
    while let Some(action) = trial.actions.row(steps).filter(|action| action.iter().all(|x| !x.is_nan())) {
        let step = env.step(action).map_err(|error| fail(steps + 1, &error))?;
        steps += 1;
        rows.compare(env, trial, steps);
        if let Some(refused) = step.fault {
            fault = Some(format!("step {steps}: {refused}"));
            break;
        }
    }
    let state = &env.scene().data.state;
    let last = |part: &str, own: &[f64]| trial.part(part)?.last().map(|recorded| distance(own, recorded));
    Ok(Outcome {
        trial: name.to_owned(),
        steps,
        from_seed: drawn && start.is_none() && !redrawn,
        qpos: last("qpos", &state.qpos),
        qvel: last("qvel", &state.qvel),
        observations: rows.observations,
        rewards: rows.rewards,
        fault,
    })
}

/// Greatest differences over the rows of a trial.
#[derive(Default)]
struct Greatest {
    observations: Option<f64>,
    rewards: Option<f64>,
}

impl Greatest {
    fn compare(&mut self, env: &Env, trial: &Recorded, row: usize) {
        let greatest = |own: &[f64], column: Option<&Column>| {
            let recorded = column?.row(row).filter(|recorded| recorded.len() == own.len())?;
            own.iter().zip(recorded).map(|(&a, &b)| difference(a, b)).reduce(f64::max)
        };
        let largest = |known: Option<f64>, new: Option<f64>| known.into_iter().chain(new).reduce(f64::max);
        self.observations =
            largest(self.observations, greatest(env.observation(), trial.observations.as_ref()));
        self.rewards = largest(self.rewards, greatest(&[env.reward()], trial.rewards.as_ref()));
    }
}

/// Distance of two numbers; two that are NaN are equal, and one that is not is infinitely far from one that is.
fn difference(a: f64, b: f64) -> f64 {
    match (a.is_nan(), b.is_nan()) {
        _ if a == b => 0.0,
        (true, true) => 0.0,
        (false, false) => (a - b).abs(),
        _ => f64::INFINITY,
    }
}

/// Euclidean distance of the values that both have.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(&a, &b)| difference(a, b).powi(2)).sum::<f64>().sqrt()
}

/// Upper ends of the histogram's bins; the first holds exact replays.
const BINS: [f64; 9] = [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0];

/// Characters of the longest bar.
const BAR: usize = 40;

fn show_table(id: &str, outcomes: &[Outcome]) {
    show!("{id}: {} trials replayed", outcomes.len());
    let width = outcomes.iter().map(|outcome| outcome.trial.len()).max().unwrap_or(0).max(5);
    show!("{:<width$}  steps  start     |qpos|      |qvel|  observations     rewards", "trial");
    let number =
        |x: Option<f64>| x.map_or("-".to_owned(), |x| if x == 0.0 { "0".into() } else { format!("{x:.3e}") });
    for outcome in outcomes {
        let Outcome { trial, steps, .. } = outcome;
        let start = if outcome.from_seed { "seed " } else { "state" };
        let [qpos, qvel, observations, rewards] =
            [outcome.qpos, outcome.qvel, outcome.observations, outcome.rewards].map(number);
        show!(
            "{trial:<width$}  {steps:5}  {start} {qpos:>10}  {qvel:>10}  {observations:>12}  {rewards:>10}"
        );
        outcome.fault.iter().for_each(|fault| note(&format!("{trial}, {fault}")));
    }
    show_histogram(&outcomes.iter().filter_map(|outcome| outcome.qpos).collect::<Vec<_>>());
}

/// Counts trials by the distance of their last states.
fn show_histogram(distances: &[f64]) {
    if distances.is_empty() {
        show!("the recording holds no states to compare");
        return;
    }
    let mut counts = [0; BINS.len() + 1];
    for &distance in distances {
        counts[BINS.iter().position(|&end| distance <= end).unwrap_or(BINS.len())] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    show!("");
    show!("last |qpos|     trials");
    for (bin, count) in counts.into_iter().enumerate() {
        let label = match BINS.get(bin) {
            Some(0.0) => "exactly 0".to_owned(),
            Some(end) => format!("up to {end:.0e}"),
            None => "more".to_owned(),
        };
        show!(
            "{}",
            format!("{label:<12}  {count:8}  {}", "#".repeat((count * BAR).div_ceil(most))).trim_end()
        );
    }
}
