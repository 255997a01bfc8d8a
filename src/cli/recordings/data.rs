//! `data`: what is in recordings of episodes, repair, conversion, replay.

use crate::failure::{Failure, unwritable};
use crate::output::{check_place, hdf5_file, is_same_file, keep_existing, keep_input, recording_file};
use crate::recordings::export::{self, Export};
use crate::recordings::names::{LayoutName, PrecisionName};
use crate::recordings::open::open;
use crate::recordings::replay::{self, Replay};
use crate::terminal::{note, show, show_json};
use clap::{Args, Subcommand, ValueHint};
use dataset::trace::{
    ColumnSummary, Layout, Summary, Target, TraceError, TrialSummary, convert, repair, summarise,
};
use serde_json::{Value, json};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Look into recordings of episodes, repair, convert and replay them
#[derive(Args)]
#[command(
    after_help = "A recording is an HDF5 file in the layout of RoboHive (TrialN/time, observations, actions, rewards, \
done, env_infos/...) or RoboSet (TrialN/data/..., derived/..., config/...), or a numpy archive with the same names, \
TrialN/ before each.

Examples:
  robohive data inspect validation/reference/traces/robohive.h5
  robohive data convert validation/reference/traces/robohive.h5 trials.npz --force"
)]
pub struct Data {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Say what is in a recording: layout, trials, and of each name type, shape and range
    Inspect(Inspect),
    /// Save what is readable of a damaged recording
    Repair(Repair),
    /// Write a recording in another layout, format or precision
    Convert(Convert),
    /// Write a recording as a dataset that Minari or LeRobot loads
    Export(Export),
    /// Replay the actions of a recording and say how far it ends from what was recorded
    Replay(Replay),
}

/// Say what is in a recording: layout, trials, and of each name type, shape and range
#[derive(Args)]
#[command(
    after_help = "Every number is read, so that damage is found. A trial counts as solved when more than five of its \
rows are, as RoboHive's evaluate_success does, or when its config/solved is not zero. In JSON, numbers that are not \
finite are the strings \"Infinity\" and \"-Infinity\".

Examples:
  robohive data inspect validation/reference/traces/robohive.h5
  robohive data inspect validation/reference/traces/roboset.h5 --trials
  robohive data inspect validation/reference/traces/robohive.h5 --json | jq .trials[0].columns
  robohive data inspect - < validation/reference/traces/robohive.h5"
)]
struct Inspect {
    /// HDF5 file or numpy archive; - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Show every trial on its own
    #[arg(long, conflicts_with = "json")]
    trials: bool,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,
}

/// Save what is readable of a damaged recording
#[derive(Args)]
#[command(
    after_help = "Without --out the repaired recording takes the place of FILE, whose content stays in FILE.damaged; a \
recording without damage is left alone. What is lost is named. Recordings made by `robohive` can be read whenever \
their process was killed: repair frees what was written of the episode that was not finished.

Examples:
  robohive data repair validation/reference/traces/robohive.h5 --out repaired.h5"
)]
struct Repair {
    /// HDF5 file
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Write here and leave FILE as it is
    #[arg(long, value_name = "FILE.h5", value_hint = ValueHint::FilePath, value_parser = hdf5_file)]
    out: Option<PathBuf>,
}

/// Write a recording in another layout, format or precision
#[derive(Args)]
#[command(
    after_help = "The ending of OUT says what is written: .npz is a numpy archive, .h5 and .hdf5 are HDF5. What has no \
place in the output is named. Reduced precision is that of RoboHive's own recordings, uint8, int8 and float16; a number \
out of range is an error, where the original writes a wrong one.

RoboSet's layout takes actions, the joints of arm and gripper, the pose of the gripper, and images of the cameras left, \
right, top and wrist.

Examples:
  robohive data convert validation/reference/traces/robohive.h5 trials.npz --force
  robohive data convert trials.npz trials.h5 --force
  robohive data convert trials.h5 small.h5 --precision reduced --force
  robohive data convert trials.h5 roboset.h5 --layout roboset --force"
)]
struct Convert {
    /// HDF5 file or numpy archive; - for standard input
    #[arg(value_name = "IN", value_hint = ValueHint::FilePath)]
    input: PathBuf,
    /// File to write, .npz, .h5 or .hdf5
    #[arg(value_hint = ValueHint::FilePath, value_parser = recording_file)]
    out: PathBuf,
    /// Layout of the output [default: that of the input]
    #[arg(long)]
    layout: Option<LayoutName>,
    /// Precision of numbers
    #[arg(long, default_value = "full")]
    precision: PrecisionName,
    /// Replace OUT if it exists
    #[arg(long)]
    force: bool,
}

/// Solved rows from which on a trial is not solved by chance.
const SOLVED_ROWS: usize = 5;

/// Runs the command.
pub fn run(a: &Data) -> Result<(), Failure> {
    match &a.command {
        Command::Inspect(a) => inspect(a),
        Command::Repair(a) => run_repair(a),
        Command::Convert(a) => run_convert(a),
        Command::Export(a) => export::run(a),
        Command::Replay(a) => replay::run(a),
    }
}

fn inspect(a: &Inspect) -> Result<(), Failure> {
    let trace = open(&a.file)?;
    let summary = summarise(&trace).map_err(Failure::usage)?;
    if a.json {
        show_json(&to_json(&summary));
    } else {
        show_summary(trace.path(), &summary, a.trials);
    }
    Ok(())
}

/// Whether a trial was solved, where it says so.
fn is_solved(trial: &TrialSummary) -> Option<bool> {
    let solved = trial.solved?;
    Some(if trial.layout == Some(Layout::RoboSet) { solved > 0 } else { solved > SOLVED_ROWS })
}

fn layout_name(summary: &Summary) -> &'static str {
    let mut layouts: Vec<_> = summary.trials.iter().map(|trial| trial.layout).collect();
    layouts.dedup();
    match layouts[..] {
        [] => "none",
        [Some(layout)] => layout.name(),
        [None] => "neither RoboHive's nor RoboSet's",
        _ => "differs from trial to trial",
    }
}

fn show_summary(path: &Path, summary: &Summary, each: bool) {
    let line = |key: &str, value: String| show!("{key:<12} {value}");
    line("recording", path.display().to_string());
    summary.attributes.iter().for_each(|(name, text)| line(name, text.clone()));
    line("layout", layout_name(summary).to_owned());
    let rows: usize = summary.trials.iter().map(|trial| trial.rows).sum();
    line("trials", format!("{} with {rows} rows", summary.trials.len()));
    let verdicts: Vec<bool> = summary.trials.iter().filter_map(is_solved).collect();
    if !verdicts.is_empty() {
        let solved = verdicts.iter().filter(|&&solved| solved).count();
        let share = 100.0 * solved as f64 / verdicts.len() as f64;
        line("solved", format!("{solved} of {} trials ({share:.1} %)", verdicts.len()));
    }
    if each {
        for trial in &summary.trials {
            show!("");
            show!("{} with {} rows", trial.name, trial.rows);
            show_columns(trial.columns.iter().map(Merged::of).collect());
        }
    } else if !summary.trials.is_empty() {
        show!("");
        show_columns(merged(summary));
    }
}

/// Datasets of one key, of one or several trials.
struct Merged {
    key: String,
    kind: String,
    /// Shape of a row, or of all.
    shape: String,
    range: Option<(f64, f64)>,
    nans: usize,
    text: Option<String>,
    trials: usize,
}

impl Merged {
    fn of(column: &ColumnSummary) -> Self {
        let shape = match &column.shape[..] {
            [] => "scalar".to_owned(),
            [_, row @ ..] => {
                let axes: Vec<_> = row.iter().map(usize::to_string).collect();
                format!("rows{}{}", if row.is_empty() { "" } else { " x " }, axes.join(" x "))
            }
        };
        Merged {
            key: column.key.clone(),
            kind: column.kind.name().to_owned(),
            shape,
            range: column.range,
            nans: column.nans,
            text: column.text.clone(),
            trials: 1,
        }
    }

    fn add(&mut self, other: Merged) {
        for (own, new) in [(&mut self.kind, other.kind), (&mut self.shape, other.shape)] {
            if *own != new {
                *own = "differs".into();
            }
        }
        self.range = match (self.range, other.range) {
            (Some((a, b)), Some((c, d))) => Some((a.min(c), b.max(d))),
            (a, b) => a.or(b),
        };
        self.nans += other.nans;
        self.trials += 1;
    }
}

/// The datasets of all trials, by key, in order of first appearance.
fn merged(summary: &Summary) -> Vec<Merged> {
    let mut out: Vec<Merged> = Vec::new();
    for column in summary.trials.iter().flat_map(|trial| &trial.columns) {
        let new = Merged::of(column);
        match out.iter_mut().find(|known| known.key == new.key) {
            Some(known) => known.add(new),
            None => out.push(new),
        }
    }
    for column in out.iter_mut().filter(|column| column.trials < summary.trials.len()) {
        column.kind += &format!(" (in {} of {} trials)", column.trials, summary.trials.len());
    }
    out
}

fn show_columns(columns: Vec<Merged>) {
    let width = |of: fn(&Merged) -> &str| columns.iter().map(|c| of(c).chars().count()).max().unwrap_or(0);
    let (keys, shapes, kinds) = (width(|c| &c.key), width(|c| &c.shape), width(|c| &c.kind));
    for column in &columns {
        let range =
            column.range.map_or(String::new(), |(low, high)| format!("{} to {}", shown(low), shown(high)));
        let nans = if column.nans == 0 { String::new() } else { format!(", {} NaN", column.nans) };
        let text = column.text.as_ref().map_or(String::new(), |text| format!("{text:?}"));
        let line = format!(
            "{:<keys$}  {:<shapes$}  {:<kinds$}  {range}{nans}{text}",
            column.key, column.shape, column.kind
        );
        show!("{}", line.trim_end());
    }
}

/// A number with six digits behind the point, or in powers of ten where that would be long.
fn shown(x: f64) -> String {
    if x.abs() < 1e15 || !x.is_finite() { format!("{x:.6}") } else { format!("{x:.6e}") }
}

/// A number, spelt where JSON has none for it.
fn number(x: f64) -> Value {
    match x {
        f64::INFINITY => "Infinity".into(),
        f64::NEG_INFINITY => "-Infinity".into(),
        x => x.into(),
    }
}

fn to_json(summary: &Summary) -> Value {
    let column = |c: &ColumnSummary| {
        json!({
            "key": c.key,
            "dtype": c.kind.name(),
            "shape": c.shape,
            "min": c.range.map(|(low, _)| number(low)),
            "max": c.range.map(|(_, high)| number(high)),
            "nan": c.nans,
            "text": c.text,
        })
    };
    let trial = |trial: &TrialSummary| {
        json!({
            "name": trial.name,
            "layout": trial.layout.map(Layout::name),
            "rows": trial.rows,
            "solved_rows": trial.solved,
            "solved": is_solved(trial),
            "columns": trial.columns.iter().map(column).collect::<Vec<_>>(),
        })
    };
    json!({
        "attributes": summary.attributes.iter().cloned().map(|(name, text)| (name, text.into())).collect::<serde_json::Map<_, _>>(),
        "trials": summary.trials.iter().map(trial).collect::<Vec<_>>(),
    })
}

fn run_repair(a: &Repair) -> Result<(), Failure> {
    let beside = |ending: &str| {
        let mut path = OsString::from(&a.file);
        path.push(ending);
        PathBuf::from(path)
    };
    if let Some(out) = &a.out {
        if is_same_file(out, &a.file) {
            return Err(Failure::usage("--out is FILE itself: leave it out to repair in place"));
        }
        check_place(out)?;
    }
    let out = a.out.clone().unwrap_or_else(|| beside(".repaired"));
    let report = repair(&a.file, &out).map_err(blame(&a.file))?;
    if let Some(damage) = &report.damage {
        show!("damage       {damage}");
    }
    if report.unused > 0 {
        show!("unfinished   {} bytes of an episode that was not finished", report.unused);
    }
    show!("saved        {} trials", report.saved.len());
    report.lost.iter().for_each(|(trial, why)| show!("lost         {trial}: {why}"));
    report.dropped.iter().for_each(|(key, why)| note(&format!("not written: {key}: {why}")));
    let sound =
        report.damage.is_none() && report.unused == 0 && report.lost.is_empty() && report.dropped.is_empty();
    match &a.out {
        Some(out) => show!("written      {}", out.display()),
        None if sound => {
            std::fs::remove_file(&out).map_err(unwritable(&out))?;
            show!("nothing to repair");
        }
        None => {
            let kept = beside(".damaged");
            std::fs::rename(&a.file, &kept).map_err(unwritable(&kept))?;
            std::fs::rename(&out, &a.file).map_err(unwritable(&a.file))?;
            show!("repaired     {}; as it was: {}", a.file.display(), kept.display());
        }
    }
    Ok(())
}

fn run_convert(a: &Convert) -> Result<(), Failure> {
    check_place(&a.out)?;
    keep_existing(&a.out, a.force)?;
    keep_input(&a.input, &a.out)?;
    let trace = open(&a.input)?;
    let target = Target { layout: a.layout.map(Layout::from), precision: a.precision.into() };
    let done = convert(&trace, &a.out, target).map_err(|error| {
        // Half a recording would look like a whole one.
        _ = std::fs::remove_file(&a.out);
        blame(trace.path())(error)
    })?;
    done.dropped.iter().for_each(|(key, why)| note(&format!("not written: {key}: {why}")));
    show!("written      {}, {} trials", a.out.display(), done.trials);
    Ok(())
}

/// Wrong input is the caller's fault, a failing output is not.
fn blame(input: &Path) -> impl Fn(TraceError) -> Failure {
    move |error| if error.path == input { Failure::usage(error) } else { Failure::new(error) }
}
