//! `bench`: steps per second, where their time goes, and how much it varies.

use crate::failure::Failure;
use crate::input::loading::{STANDARD_INPUT, load, start};
use crate::input::solver::SolverArgument;
use crate::input::source::Reading;
use crate::models::MAX_STEPS;
use crate::terminal::{show, show_json};
use clap::{Args, ValueHint, value_parser};
use dataset::NpzReader;
use library::memory::{check_room, resident_bytes};
use physics::pipeline::watch::{Stage, Watch};
use physics::{Batch, Data, Engine, Model, step_watched};
use serde_json::{Map, Value, json};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Most threads of a batch.
const MAX_THREADS: i64 = 1024;
/// Most environments of a batch.
const MAX_ENVIRONMENTS: i64 = 1 << 20;

/// Measure steps per second
#[derive(Args)]
#[command(
    after_help = "Starts from keyframe 0 where there is one, else qpos0, with zero controls; the time of loading \
is measured separately.

Examples:
  robohive bench assets/elbow/elbow.xml assets/pile/pile.xml --steps 2000 --json | tail -n 1
  robohive bench assets/pile/pile.xml --batch 64 --threads 2   many environments together
  robohive bench assets/pile/pile.xml --stages                 where the time of a step goes
  robohive bench assets/pile/pile.xml --jitter --steps 10000   p99.9 of the time of a step"
)]
pub struct Bench {
    /// MJCF files or compiled models
    #[arg(required = true, value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub models: Vec<PathBuf>,
    /// How they are read
    #[command(flatten)]
    pub reading: Reading,
    /// Steps of each environment
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = value_parser!(u32).range(1..=MAX_STEPS as i64))]
    pub steps: u32,
    /// Threads that step the environments
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=MAX_THREADS))]
    pub threads: u32,
    /// Environments (default: one a thread); they must fit in free memory
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=MAX_ENVIRONMENTS))]
    pub batch: Option<u32>,
    /// Archive with rows of controls, array ctrl, or a recorded reference; after the last row the motion starts again
    #[arg(long, value_name = "FILE.npz", value_hint = ValueHint::FilePath)]
    pub controls: Option<PathBuf>,
    /// Steps that a row of controls holds; there a batch waits for all its environments
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = value_parser!(u32).range(1..))]
    pub hold: u32,
    /// Mean time of each stage of a step
    #[arg(long, conflicts_with_all = ["threads", "batch"])]
    pub stages: bool,
    /// Quantiles of the time of single steps
    #[arg(long, conflicts_with_all = ["threads", "batch", "stages"])]
    pub jitter: bool,
    /// What moves them; others than our own step one environment on one thread
    #[command(flatten)]
    pub solver: SolverArgument,
    /// Measure what standard input asks for, lines "rate N", "stages N" or "jitter N", for one model
    #[arg(long, conflicts_with_all = ["stages", "jitter"])]
    pub requests: bool,
    /// Print one JSON object a model; the last line is the last model's
    #[arg(long)]
    pub json: bool,
}

/// What is measured.
#[derive(Clone, Copy)]
enum Measure {
    Rate,
    Stages,
    Jitter,
}

/// Runs the command.
pub fn run(a: &Bench) -> Result<(), Failure> {
    if a.requests && a.models.iter().any(|path| path == Path::new(STANDARD_INPUT)) {
        return Err(Failure::usage("--requests reads standard input, which then cannot hold the model"));
    }
    for path in &a.models {
        let workload = Workload::new(a, path)?;
        if !a.solver.is_own() && (a.stages || a.requests || a.batch.is_some() || a.threads > 1) {
            return Err(Failure::usage(
                "--solver rapier steps one environment: remove --batch, --threads, --stages and --requests",
            ));
        }
        if a.requests {
            answer(&workload)?;
            continue;
        }
        let measure = match (a.stages, a.jitter) {
            (true, _) => Measure::Stages,
            (_, true) => Measure::Jitter,
            _ => Measure::Rate,
        };
        let mut found = Map::new();
        found.insert("model".into(), json!(path.display().to_string()));
        found.extend(workload.measure(measure, a.steps as usize)?);
        if a.json {
            show_json(&Value::Object(found));
        } else {
            print(measure, &found);
        }
    }
    Ok(())
}

/// Answers each line `rate N`, `stages N` or `jitter N` of standard input by a line of JSON, until the input ends:
/// another program measures the processor time in between.
fn answer(workload: &Workload) -> Result<(), Failure> {
    for line in std::io::stdin().lines() {
        let line = line.map_err(Failure::new)?;
        let (measure, steps) = line
            .split_once(' ')
            .and_then(|(name, steps)| {
                let measure = match name {
                    "rate" => Measure::Rate,
                    "stages" => Measure::Stages,
                    "jitter" => Measure::Jitter,
                    _ => return None,
                };
                Some((measure, steps.parse().ok().filter(|&n| (1..=MAX_STEPS as usize).contains(&n))?))
            })
            .ok_or_else(|| {
                Failure::usage(format!(
                    "request {line:?} is not rate, stages or jitter and a number of steps, 1 to {MAX_STEPS}"
                ))
            })?;
        show_json(&Value::Object(workload.measure(measure, steps)?));
    }
    Ok(())
}

/// Most steps whose times are kept: 800 MB of them.
const MAX_TIMES: usize = 100_000_000;

/// Bytes of one simulation: its arrays, and as much again for contacts, their rows and working memory.
fn environment_bytes(m: &Model, d: &Data) -> usize {
    let mut bytes = size_of::<Data>();
    d.visit(m, &mut |_, _, values| values.pieces(&mut |piece| bytes += piece.len()));
    2 * bytes
}

/// What is simulated: environments from one start, under one sequence of controls.
struct Workload {
    m: Arc<Model>,
    start: Data,
    controls: Vec<f64>,
    rows: usize,
    hold: usize,
    environments: usize,
    threads: usize,
    load_seconds: f64,
    engine: Engine,
}

impl Workload {
    /// Keyframe 0 where there is one, else `qpos0`; zero controls, or the rows of the file.
    fn new(a: &Bench, path: &Path) -> Result<Self, Failure> {
        let began = Instant::now();
        let m = load(path, &a.reading)?;
        let load_seconds = began.elapsed().as_secs_f64();
        let mut start = start(&m, None)?;
        start.state.ctrl.fill(0.0);
        let (controls, rows) = match &a.controls {
            Some(path) => controls(path, &m)?,
            None => (Vec::new(), 0),
        };
        let environments = a.batch.unwrap_or(a.threads) as usize;
        check_room(environments, environment_bytes(&m, &start)).map_err(|no_room| {
            Failure::usage(format!("{no_room}: give --batch at most {}", no_room.fitting()))
        })?;
        Ok(Workload {
            m: m.into(),
            start,
            controls,
            rows,
            hold: a.hold as usize,
            environments,
            threads: a.threads as usize,
            load_seconds,
            engine: a.solver.engine()?,
        })
    }

    fn measure(&self, measure: Measure, steps: usize) -> Result<Map<String, Value>, Failure> {
        match measure {
            Measure::Rate => self.rate(steps),
            Measure::Stages => self.stages(steps),
            Measure::Jitter => self.jitter(steps),
        }
    }

    /// Sets the controls that hold from step `done` on; after the last row the motion starts again.
    fn set_controls(&self, done: usize, d: &mut Data) {
        let nu = self.m.nu;
        if self.rows == 0 || !done.is_multiple_of(self.hold) {
            return;
        }
        let row = done / self.hold % self.rows;
        if row == 0 {
            d.state.clone_from(&self.start.state);
        }
        d.state.ctrl.copy_from_slice(&self.controls[row * nu..(row + 1) * nu]);
    }

    fn failed(&self, error: impl Display) -> Failure {
        Failure::new(format!("{}: {error}", self.m.name))
    }

    /// Steps per second of all environments together, and the memory of the process.
    fn rate(&self, steps: usize) -> Result<Map<String, Value>, Failure> {
        if self.engine.name() != Engine::OWN {
            return self.rate_of_one(steps);
        }
        let mut batch = Batch::new(self.m.clone(), self.environments, self.threads).map_err(Failure::new)?;
        batch.data_mut().iter_mut().for_each(|d| d.clone_from(&self.start));
        let began = Instant::now();
        for done in (0..steps).step_by(self.hold) {
            batch.data_mut().iter_mut().for_each(|d| self.set_controls(done, d));
            batch.step(self.hold.min(steps - done)).map_err(|e| self.failed(e))?;
        }
        Ok(self.found(steps, began.elapsed().as_secs_f64(), &batch.data()[0]))
    }

    /// The same of one environment, which another engine moves.
    fn rate_of_one(&self, steps: usize) -> Result<Map<String, Value>, Failure> {
        let mut mover = self.engine.start(&self.m).map_err(|e| self.failed(e))?;
        let mut d = self.start.clone();
        let began = Instant::now();
        for done in 0..steps {
            self.set_controls(done, &mut d);
            mover.step(&self.m, &mut d).map_err(|e| self.failed(e))?;
        }
        Ok(self.found(steps, began.elapsed().as_secs_f64(), &d))
    }

    fn found(&self, steps: usize, seconds: f64, first: &Data) -> Map<String, Value> {
        let mut found = Map::new();
        found.insert("steps".into(), json!(steps));
        found.insert("environments".into(), json!(self.environments));
        found.insert("threads".into(), json!(self.threads));
        found.insert("steps_per_second".into(), json!((steps * self.environments) as f64 / seconds));
        found.insert("load_seconds".into(), json!(self.load_seconds));
        found.insert("resident_bytes".into(), json!(resident_bytes()));
        found.insert("qpos".into(), json!(first.state.qpos));
        found
    }

    /// Seconds of each stage of a step, means.
    fn stages(&self, steps: usize) -> Result<Map<String, Value>, Failure> {
        let mut d = self.start.clone();
        let mut clock = Clock { last: Instant::now(), spent: Default::default() };
        for done in 0..steps {
            self.set_controls(done, &mut d);
            clock.last = Instant::now();
            step_watched(&self.m, &mut d, &mut clock).map_err(|e| self.failed(e))?;
        }
        let mean = |stage: Stage| json!(clock.spent[stage as usize].as_secs_f64() / steps as f64);
        Ok(Stage::ALL.map(|stage| (format!("{stage:?}").to_lowercase(), mean(stage))).into_iter().collect())
    }

    /// Seconds of single steps: their median, and what all but a thousandth of them stay under. Under controls that
    /// repeat, the same of the least time that each step of the sequence took: what other work on the machine adds is
    /// left out.
    fn jitter(&self, steps: usize) -> Result<Map<String, Value>, Failure> {
        if steps > MAX_TIMES {
            return Err(Failure::usage(format!(
                "--jitter keeps the time of every step: at most {MAX_TIMES} fit"
            )));
        }
        let mut d = self.start.clone();
        let mut mover = self.engine.start(&self.m).map_err(|e| self.failed(e))?;
        let mut seconds = Vec::with_capacity(steps);
        for done in 0..steps {
            self.set_controls(done, &mut d);
            let began = Instant::now();
            mover.step(&self.m, &mut d).map_err(|e| self.failed(e))?;
            seconds.push(began.elapsed().as_secs_f64());
        }
        let mut found = quantiles(&mut seconds.clone(), "");
        let pass = self.rows * self.hold;
        if pass > 0 && steps >= 2 * pass {
            let repeats = |i: usize| seconds[i..].iter().step_by(pass).copied().fold(f64::MAX, f64::min);
            found.extend(quantiles(&mut (0..pass).map(repeats).collect::<Vec<_>>(), "least "));
        }
        Ok(found)
    }
}

/// Median and upper quantiles, under names with a prefix.
fn quantiles(seconds: &mut [f64], prefix: &str) -> Map<String, Value> {
    seconds.sort_by(f64::total_cmp);
    let quantile = |q: f64| seconds[((seconds.len() - 1) as f64 * q).round() as usize];
    let named = [("median", 0.5), ("p99", 0.99), ("p99.9", 0.999), ("most", 1.0)];
    named.into_iter().map(|(name, q)| (format!("{prefix}{name}"), json!(quantile(q)))).collect()
}

/// Rows of controls, flat, and their number.
fn controls(path: &Path, m: &Model) -> Result<(Vec<f64>, usize), Failure> {
    let archive = NpzReader::open(path).map_err(Failure::usage)?;
    let name = ["rollout.ctrl", "ctrl"].into_iter().find(|name| archive.contains(name)).unwrap_or("ctrl");
    let array = archive.require(name).map_err(Failure::usage)?;
    let (values, rows) = (array.values.to_f64(), array.rows());
    if rows == 0 || values.len() != rows * m.nu {
        return Err(Failure::usage(format!(
            "{}: {name} is {:?}; rows of {} controls are needed",
            path.display(),
            array.shape,
            m.nu
        )));
    }
    Ok((values, rows))
}

/// Reads the clock at the end of every stage.
struct Clock {
    last: Instant,
    spent: [Duration; Stage::ALL.len()],
}

impl Watch for Clock {
    fn ended(&mut self, stage: Stage) {
        let now = Instant::now();
        self.spent[stage as usize] += now - self.last;
        self.last = now;
    }
}

fn print(measure: Measure, found: &Map<String, Value>) {
    let number = |name: &str| found[name].as_f64().unwrap_or(f64::NAN);
    let model = found["model"].as_str().unwrap_or_default();
    let timed = || found.iter().filter_map(|(name, value)| Some((name, value.as_f64()?)));
    match measure {
        Measure::Rate => show!(
            "{:>10.0} steps/s  {} environment(s)  {} thread(s)  {:>5.0} MiB  {model}",
            number("steps_per_second"),
            number("environments"),
            number("threads"),
            number("resident_bytes") / 1_048_576.0,
        ),
        Measure::Stages => {
            let whole: f64 = timed().map(|(_, seconds)| seconds).sum();
            show!("{:>10.2} us a step  {model}", whole * 1e6);
            for (stage, seconds) in timed() {
                show!("{:>10.2} us {:>5.1} %  {stage}", seconds * 1e6, 100.0 * seconds / whole);
            }
        }
        Measure::Jitter => {
            let values: Vec<_> =
                timed().map(|(name, seconds)| format!("{name} {:.1} us", seconds * 1e6)).collect();
            show!("{:>5.2} x  {}  {model}", number("p99.9") / number("median"), values.join(", "));
        }
    }
}
