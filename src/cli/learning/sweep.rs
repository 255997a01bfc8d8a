//! `sweep`: runs over settings and seeds, several at a time.

use super::comparing::{Compared, show_compared};
use super::starting::{Starting, begin, environment};
use super::varying::{Seeds, variation};
use crate::failure::Failure;
use crate::input::policy::failure;
use crate::interrupt::Interrupt;
use agents::run::{Config, Run, teacher};
use agents::sweep::{Combination, Variation, combinations};
use clap::{Args, ValueHint};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Train over settings and seeds, several runs at a time
#[derive(Args)]
#[command(
    after_help = "Each combination of values and each seed is a run in a folder of its own within FOLDER, with the bits of the run that `train` makes \
of its run.toml: `evaluate`, `report` and `train --resume` take it. The same command again skips what is finished and resumes the rest, after Ctrl-C \
too; with more --iterations it makes those that are missing. A run that fails stops no other.

KEY is a setting's path in run.toml, such as learning.fit.rate, learning.episodes or environment.frame_skip. Values are TOML, or text. A comma \
within brackets or quotation marks separates no values: learning.hidden=[[32,32],[64,64]],[[64,64],[64,64]] are two; a shell wants such a list \
in quotation marks. A sweep has at most 1000 runs.

The table has the last iteration's episodes, whose actions are drawn: the mean success over seeds, the least and the most of a seed, and the mean \
return. They are as many as an iteration has, and the best of many combinations looks better than it is: `report` plays others.

Examples:
  robohive sweep hive/myoElbowPose1D6MRandom-v0 --iterations 1 --seeds 2 --out sizes\\
 --vary learning.episodes=4,8
  robohive report sizes/episodes=4-seed1 sizes/episodes=8-seed1 --episodes 10
  robohive sweep sizes/episodes=4-seed1/run.toml --seeds 3,5 --out rates --json --jobs 1\\
 --vary learning.fit.rate=0.001,0.01"
)]
pub struct Sweep {
    /// Id of the environment, or the run.toml of a run
    #[arg(value_name = "ID|CONFIG")]
    what: String,
    /// What is trained, and how
    #[command(flatten)]
    starting: Starting,
    /// A setting, and the values that it takes; again for others, in every combination
    #[arg(long, value_name = "KEY=V1,V2", value_parser = variation)]
    vary: Vec<Variation>,
    /// Seeds of each combination: N for 1 to N, or a list such as 1,2,5; "7," is the seed 7 alone [default: 1, or what CONFIG says]
    #[arg(long, value_name = "N|LIST")]
    seeds: Option<Seeds>,
    /// Iterations of each run [default: 100, or what CONFIG says]
    #[arg(long, value_name = "N")]
    iterations: Option<u64>,
    /// Folder for the folders of runs
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Runs at a time, on a thread each; 0 for as many as there are cores. They make no difference to what is learnt
    #[arg(long, value_name = "N", default_value_t = 0)]
    jobs: usize,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// A run that is asked for.
struct Planned {
    /// The place of its combination.
    combination: usize,
    folder: PathBuf,
    config: Config,
    /// Iterations that its last checkpoint has; none where there is no run yet.
    made: Option<u64>,
}

/// Runs the command.
pub fn run(a: &Sweep) -> Result<(), Failure> {
    let mut config = a.starting.config(&a.what)?;
    a.starting.check(&config)?;
    config.iterations = a.iterations.unwrap_or(config.iterations);
    let seeds = a.seeds.as_ref().map_or(vec![config.seed], |Seeds(seeds)| seeds.clone());
    let combinations = combinations(&config, &a.vary, seeds.len()).map_err(failure)?;
    check(a, &combinations)?;
    let runs = plan(&a.out, &combinations, &seeds)?;
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let ends = train_all(a, &runs, &interrupt);
    let mut failed = Vec::new();
    let mut rows: Vec<_> = combinations
        .iter()
        .map(|combination| Compared { combination, runs: seeds.len(), finished: Vec::new() })
        .collect();
    for (run, end) in runs.iter().zip(&ends) {
        match end {
            Ok(true) => {
                let last = Run::rows_of(&run.folder).map_err(failure)?.pop();
                rows[run.combination].finished.extend(last.map(|row| (run.config.seed, row)));
            }
            Ok(false) => {}
            Err(why) => failed.push((run.folder.display().to_string(), why.to_string())),
        }
    }
    let list: String = failed.iter().map(|(run, why)| format!("\n{run}: {why}")).collect();
    let failures = format!("{} of {} runs failed:{list}", failed.len(), runs.len());
    if let Some(code) = interrupt.code().filter(|_| ends.iter().any(|end| matches!(end, Ok(false)))) {
        let mut message = "interrupted; the same command resumes what is not finished".to_owned();
        if !failed.is_empty() {
            message = format!("{message}\n{failures}");
        }
        return Err(Failure { code, ..Failure::new(message) });
    }
    show_compared(&a.out, rows, &failed, a.json);
    if failed.is_empty() { Ok(()) } else { Err(Failure::new(failures)) }
}

/// Refuses combinations whose environment cannot be made, or whose teacher is missing.
fn check(a: &Sweep, combinations: &[Combination]) -> Result<(), Failure> {
    let made = |config: &Config| {
        let Config { id, compat, solver, environment, teacher, .. } = config.clone();
        (id, compat, solver, environment, teacher)
    };
    for (place, Combination { config, .. }) in combinations.iter().enumerate() {
        let taught = config.teaching().map_err(failure)?;
        // Environments can be slow to make, and most sweeps have one.
        if combinations[..place].iter().any(|other| made(&other.config) == made(config)) {
            continue;
        }
        let env = environment(a.starting.making.clone(), config)?;
        taught.map_or(Ok(()), |taught| teacher(&taught.by, &env).map(drop)).map_err(failure)?;
    }
    Ok(())
}

/// The runs that are asked for, with what there is of them.
fn plan(out: &Path, combinations: &[Combination], seeds: &[u64]) -> Result<Vec<Planned>, Failure> {
    let mut runs = Vec::new();
    for (place, combination) in combinations.iter().enumerate() {
        for &seed in seeds {
            let config = Config { seed, ..combination.config.clone() };
            let folder = out.join(combination.folder(seed));
            let made = made(&folder, &config)?;
            runs.push(Planned { combination: place, folder, config, made });
        }
    }
    Ok(runs)
}

/// Iterations that there are of a run in its folder, which is to be that of its configuration.
fn made(folder: &Path, config: &Config) -> Result<Option<u64>, Failure> {
    match std::fs::read_dir(folder).map(Iterator::count) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Failure::usage(format!("{}: {error}", folder.display()))),
        Ok(0) => return Ok(None),
        Ok(_) => {}
    }
    let mut stored = Run::config_of(folder).map_err(failure)?;
    // What is missing is made.
    stored.iterations = stored.iterations.max(config.iterations);
    let (stored, asked) = (stored.settings().map_err(failure)?, config.settings().map_err(failure)?);
    let differs = |key: &&String| stored.get(*key) != asked.get(*key);
    if let Some(key) = stored.keys().chain(asked.keys()).find(differs) {
        let [there, here] =
            [&stored, &asked].map(|settings| settings.get(key).map_or("nothing", String::as_str));
        return Err(Failure::usage(format!(
            "{}: its run.toml has {there} for {key}, and {here} is asked for: name another folder",
            folder.display()
        )));
    }
    Run::iterations_of(folder).map(Some).map_err(|error| {
        Failure::usage(format!("{error}; without the folder {} the run is made again", folder.display()))
    })
}

/// Makes what there is not yet of each run; whether it is finished, or why it failed.
fn train_all(a: &Sweep, runs: &[Planned], interrupt: &Interrupt) -> Vec<Result<bool, Failure>> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = if a.jobs == 0 { cores } else { a.jobs }.min(runs.len());
    let bar = progress(a, runs);
    let (next, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        let mut ends = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(run) = runs.get(place) else { return ends };
            ends.push((place, train(a, run, interrupt, &bar)));
            let ended = ended.fetch_add(1, Ordering::Relaxed) + 1;
            bar.set_message(format!("{ended} of {} runs", runs.len()));
        }
    };
    let mut ends: Vec<_> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        let end = |thread: std::thread::ScopedJoinHandle<'_, Vec<_>>| {
            thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        running.into_iter().flat_map(end).collect()
    });
    bar.finish_and_clear();
    ends.sort_unstable_by_key(|(place, _)| *place);
    ends.into_iter().map(|(_, end)| end).collect()
}

/// Makes a run, or resumes it, until it is finished or the sweep is interrupted; whether it is finished.
fn train(a: &Sweep, planned: &Planned, interrupt: &Interrupt, bar: &ProgressBar) -> Result<bool, Failure> {
    let Planned { folder, config, made, .. } = planned;
    if made.is_some_and(|made| made >= config.iterations) {
        return Ok(true);
    }
    if interrupt.code().is_some() {
        return Ok(false);
    }
    let env = environment(a.starting.making.clone(), config)?;
    let mut run = match made {
        None => begin(folder, config.clone(), &env, 1, true)?,
        Some(_) => {
            let mut run = Run::resume(folder, &env, 1).map_err(failure)?;
            run.extend(config.iterations).map_err(failure)?;
            run
        }
    };
    while !run.is_finished() && interrupt.code().is_none() {
        run.iterate().map_err(failure)?;
        bar.inc(1);
    }
    run.keep().map_err(failure)?;
    Ok(run.is_finished())
}

/// The iterations that are to be made.
fn progress(a: &Sweep, runs: &[Planned]) -> ProgressBar {
    if a.quiet || a.json {
        return ProgressBar::hidden();
    }
    let left = runs.iter().map(|run| run.config.iterations.saturating_sub(run.made.unwrap_or(0)));
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} iterations, {eta} left, {msg}");
    let bar = ProgressBar::new(left.fold(0, u64::saturating_add))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(format!("0 of {} runs", runs.len()));
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
