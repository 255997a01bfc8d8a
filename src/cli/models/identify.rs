//! `identify`: parameters of a model from recorded logs.

use crate::failure::{Failure, unwritable};
use crate::input::loading::loader;
use crate::input::source::Reading;
use crate::output::{check_place, keep_existing, keep_input};
use crate::terminal::{note, show};
use clap::{Args, ValueHint};
use dataset::NpzReader;
use identify::{Found, Log, Options, Parameter, Prior, Quantity, fragment, identify, patched, report};
use mjcf::spec::Spec;
use physics::Model;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Files that a folder gets.
const FILES: [&str; 4] = ["model.xml", "patch.xml", "parameters.csv", "report.html"];

/// Find parameters of a model with which it reads what a log has
#[derive(Args)]
#[command(
    after_help = "A log is a numpy archive as `sim --out` writes it: time, ctrl, qpos and qvel of the first row at least, and \
sensordata; without sensors, positions are compared. NaN stands for a reading that is missing. Several logs are fitted \
together.

What can be fitted: damping, frictionloss, armature and stiffness of joints, gain and kv of actuators, mass of bodies (its \
rotational inertia grows with it), delay of all controls. A word names a quantity of all elements, or ELEMENT.QUANTITY, where * \
stands for any text.

FOLDER gets model.xml, the whole model with the values found; patch.xml, the changed attributes alone; parameters.csv; and \
report.html, with curves before and after. Standard deviations are those of noise; what the log cannot tell is named.

Examples:
  robohive sim assets/elbow/elbow.xml --seconds 0.5 --out log.npz
  robohive identify log.npz --model assets/elbow/elbow.xml --fit damping,armature --out fitted
  robohive identify log.npz --model assets/elbow/elbow.xml --fit delay --prior delay=0.01,0.01"
)]
pub struct Identify {
    /// Logs, numpy archives
    #[arg(required = true, value_name = "LOG", value_hint = ValueHint::FilePath)]
    pub logs: Vec<PathBuf>,
    /// MJCF file of the model
    #[arg(long, value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub model: PathBuf,
    /// What is fitted, separated by commas
    #[arg(long, value_name = "PARAMETERS")]
    pub fit: String,
    /// Write model, patch, table and report into this folder
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Replace files in FOLDER; never one that is read
    #[arg(long)]
    pub force: bool,
    /// Keep parameters between two values: elbow.damping=0,2
    #[arg(long, value_name = "PARAMETERS=LOW,HIGH")]
    pub bounds: Vec<String>,
    /// What is known of parameters before, a mean and a standard deviation: hand.mass=0.7,0.02
    #[arg(long, value_name = "PARAMETERS=MEAN,DEVIATION")]
    pub prior: Vec<String>,
    /// Compare these columns only, by names with *, separated by commas
    #[arg(long, value_name = "COLUMNS")]
    pub columns: Option<String>,
    /// Restart from recorded states after this time, where every row has qpos and qvel [s]
    #[arg(long, value_name = "SECONDS")]
    pub window: Option<f64>,
    /// Iterations of each of three rounds, at most
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub iterations: u32,
    /// How the model is read
    #[command(flatten)]
    pub reading: Reading,
}

/// Runs the command.
pub fn run(a: &Identify) -> Result<(), Failure> {
    let out = a.out.as_deref().map(|folder| place(a, folder)).transpose()?;
    let source = std::path::absolute(&a.model).map_err(Failure::usage)?;
    let (loader, path) = loader(&source, &a.reading)?;
    let parsed = loader.parse(path).map_err(Failure::usage)?;
    let spec = parsed.spec.clone();
    let loaded = loader.compile(parsed).map_err(Failure::usage)?;
    loaded.warnings.warnings().for_each(|warning| note(&warning.to_string()));
    let model = loaded.model;
    let parameters = parameters(a, &model)?;
    let logs = a.logs.iter().map(|path| log(a, path, &model)).collect::<Result<Vec<_>, _>>()?;
    let mut options = Options::default().with_iterations(a.iterations as usize);
    if let Some(seconds) = a.window {
        if seconds.is_nan() || seconds <= 0.0 {
            return Err(Failure::usage(format!("--window {seconds}: a time is positive")));
        }
        options = options.with_window(seconds);
    }
    let found = identify(&model, &logs, &parameters, &options).map_err(Failure::usage)?;
    show_found(&found);
    if let Some(folder) = out {
        write(&folder, spec, &model, &found)?;
        show!("written      {}: {}", folder.display(), FILES.join(", "));
    }
    Ok(())
}

/// Where the files go: a folder that is there or can be made, in which none of them is, unless they may be replaced.
fn place(a: &Identify, folder: &Path) -> Result<PathBuf, Failure> {
    let folder = std::path::absolute(folder).map_err(unwritable(folder))?;
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::usage(format!("{}: this is a file: name a folder", folder.display())));
    }
    // The folder stands where a file may stand.
    if !folder.exists() {
        check_place(&folder)?;
    }
    for name in FILES {
        let file = folder.join(name);
        keep_input(&a.model, &file)?;
        a.logs.iter().try_for_each(|log| keep_input(log, &file))?;
        keep_existing(&file, a.force)?;
    }
    Ok(folder)
}

fn log(a: &Identify, path: &Path, model: &Model) -> Result<Log, Failure> {
    let of_episodes =
        |ending: &std::ffi::OsStr| ["h5", "hdf5"].iter().any(|own| ending.eq_ignore_ascii_case(own));
    if path.extension().is_some_and(of_episodes) {
        return Err(Failure::usage(format!(
            "{}: recordings of episodes hold actions of environments instead of controls: write time, ctrl, qpos, qvel and sensordata \
             to a numpy archive",
            path.display()
        )));
    }
    let archive = NpzReader::open(path).map_err(Failure::usage)?;
    let log = Log::of_archive(&path.display().to_string(), &archive, model).map_err(Failure::usage)?;
    match &a.columns {
        Some(columns) => log.only(columns).map_err(Failure::usage),
        None => Ok(log),
    }
}

/// What is fitted, with bounds and priors.
fn parameters(a: &Identify, model: &Model) -> Result<Vec<Parameter>, Failure> {
    let mut all = Quantity::choose(&a.fit, model).map_err(Failure::usage)?;
    for (option, settings) in [("--bounds", &a.bounds), ("--prior", &a.prior)] {
        for setting in settings {
            let (words, [first, second]) = pair(option, setting)?;
            let chosen = Quantity::choose(words, model).map_err(Failure::usage)?;
            let mut changed = 0;
            for p in all.iter_mut().filter(|p| chosen.iter().any(|other| other.name == p.name)) {
                let prior = Prior { mean: first, deviation: second };
                let own = p.clone();
                let new = if option == "--prior" { own.known(prior) } else { own.within(first, second) };
                *p = new.map_err(Failure::usage)?;
                changed += 1;
            }
            if changed == 0 {
                return Err(Failure::usage(format!(
                    "{option} {setting}: none of them is fitted; --fit {}",
                    a.fit
                )));
            }
        }
    }
    Ok(all)
}

/// Words, and two numbers behind them.
fn pair<'a>(option: &str, setting: &'a str) -> Result<(&'a str, [f64; 2]), Failure> {
    let parsed = setting.rsplit_once('=').and_then(|(words, numbers)| {
        let (first, second) = numbers.split_once(',')?;
        Some((words, [first.trim().parse().ok()?, second.trim().parse().ok()?]))
    });
    parsed.ok_or_else(|| Failure::usage(format!("{option} {setting:?} is not PARAMETERS=NUMBER,NUMBER")))
}

fn show_found(found: &Found) {
    let width = found.parameters.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(9);
    show!("{:width$} {:>12} {:>12} {:>10}", "parameter", "before", "after", "deviation");
    for ((p, value), deviation) in found.parameters.iter().zip(&found.values).zip(&found.deviations) {
        let certain = if deviation.is_finite() { format!("{deviation:10.2e}") } else { "  not told".into() };
        let bound = if *value <= p.lower || *value >= p.upper { " at a bound" } else { "" };
        show!("{:width$} {:12.6} {value:12.6} {certain}{bound}", p.name, p.start);
    }
    for direction in &found.unknown {
        let parts: Vec<_> =
            direction.parts.iter().map(|(name, share)| format!("{share:+.2} {name}")).collect();
        show!("not told     {}", parts.join(", "));
    }
    // The first round weighs columns by their spread alone, before and after.
    let ends =
        found.rounds.first().and_then(|round| Some((round.first()?.objective, round.last()?.objective)));
    let share = ends.map_or(0.0, |(before, after)| if before > 0.0 { after / before } else { 0.0 });
    show!("readings     {} columns; {:.2e} of the sum of squares is left", found.columns.len(), share);
    let correlated: Vec<_> = found
        .columns
        .iter()
        .zip(&found.correlation)
        .filter(|(_, c)| **c > 0.5)
        .map(|(name, _)| name.as_str())
        .collect();
    if !correlated.is_empty() {
        note(&format!(
            "residuals of {} follow each other: the model lacks something or the fit ended in a local minimum; deviations are too small",
            correlated.join(", ")
        ));
    }
}

/// Writes the files.
fn write(folder: &Path, mut spec: Spec, model: &Model, found: &Found) -> Result<(), Failure> {
    patched(&mut spec, model, found).map_err(Failure::usage)?;
    spec.settle_keys(model);
    let place = folder.to_str().ok_or_else(|| {
        Failure::usage(format!("the path '{}' is not UTF-8, as paths of models must be", folder.display()))
    })?;
    spec.place_assets(place).map_err(Failure::new)?;
    let texts = [
        spec.to_xml().map_err(Failure::new)?,
        fragment(model, found).map_err(Failure::usage)?,
        table(found),
        report(&format!("Parameters of {}", model.name), found),
    ];
    if !folder.is_dir() {
        std::fs::create_dir(folder).map_err(unwritable(folder))?;
    }
    for (name, text) in FILES.iter().zip(texts) {
        let file = folder.join(name);
        std::fs::write(&file, text).map_err(unwritable(&file))?;
    }
    Ok(())
}

/// Parameters as CSV.
fn table(found: &Found) -> String {
    let mut text = String::from("parameter,before,after,deviation,lower,upper\n");
    for ((p, value), deviation) in found.parameters.iter().zip(&found.values).zip(&found.deviations) {
        let name = p.name.replace('"', "\"\"");
        // Writing into a text cannot fail.
        let _ = writeln!(text, "\"{name}\",{},{value},{deviation},{},{}", p.start, p.lower, p.upper);
    }
    text
}
