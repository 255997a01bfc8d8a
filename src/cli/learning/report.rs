//! `report`: what several runs reached, with intervals over seeds.

use super::playing::Playing;
use super::starting::environment;
use crate::failure::{Failure, unwritable};
use crate::input::library::Making;
use crate::output::check_place;
use crate::terminal::{note, show, show_json};
use agents::Policy;
use agents::run::{Config, Row, Run};
use agents::statistics::{bootstrap, interquartile_mean, profile};
use agents::sweep::short;
use clap::{Args, ValueHint};
use env::episode::evaluate;
use identify::{Curve, plot};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Seed of what the bootstrap draws.
const SEED: u64 = 0;
/// Success \[%\] that counts as learnt.
const LEARNT: f64 = 90.0;
/// Success \[%\] above which a performance profile counts runs.
const THRESHOLDS: [f64; 10] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0];
/// Colours of algorithms (Okabe and Ito, "Color universal design", 2008).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// Say what several runs reached, with 95 % intervals over seeds
#[derive(Args)]
#[command(
    after_help = "Runs of one environment, one algorithm and the same settings are seeds of one row, which names the settings that others do not \
share; numbers of iterations may differ. Each run's policy, that of its last checkpoint, plays the same \
episodes by its mean action; so do zero and random actions, which are the floor. The row has the interquartile mean over its seeds, and its \
interval by a stratified bootstrap (Agarwal et al., 2021); three seeds are few, and one says nothing of others.

Examples:
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 1 --seed 1 --out seed1
  robohive train hive/myoElbowPose1D6MRandom-v0 --iterations 1 --seed 2 --out seed2
  robohive report seed1 seed2 --episodes 10 --html elbow.html"
)]
pub struct Report {
    /// Folders of runs
    #[arg(required = true, value_name = "RUN", value_hint = ValueHint::DirPath)]
    runs: Vec<PathBuf>,
    /// How environments are made
    #[command(flatten)]
    making: Making,
    /// Which episodes are played
    #[command(flatten)]
    playing: Playing,
    /// Write a page with the table and learning curves, without scripts
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    html: Option<PathBuf>,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

/// A run of a seed.
struct Seed {
    config: Config,
    rows: Vec<Row>,
    /// Success of its policy \[%\].
    success: f64,
}

/// Runs that differ in nothing but their seeds.
struct Group {
    /// What they have in common.
    common: Config,
    /// Settings that other groups of the environment and the algorithm do not share.
    own: BTreeMap<String, String>,
    seeds: Vec<Seed>,
    /// Success of zero and of random actions \[%\].
    floors: [f64; 2],
}

impl Group {
    fn algorithm(&self) -> &'static str {
        self.common.learning.algorithm.name()
    }

    /// What it is called.
    fn name(&self) -> String {
        let own = self.own.iter().map(|(key, value)| format!(" {}={value}", short(key)));
        format!("{}{}", self.algorithm(), own.collect::<String>())
    }

    fn scores(&self) -> Vec<f64> {
        self.seeds.iter().map(|seed| seed.success).collect()
    }

    /// The interval of the mean over seeds; none where one seed says nothing of others.
    fn interval(&self) -> Option<[f64; 2]> {
        (self.seeds.len() > 1).then(|| bootstrap(&[self.scores()], interquartile_mean, SEED))
    }

    /// Steps after which each seed first succeeded in 90 % of an iteration's episodes.
    fn learnt(&self) -> Vec<Option<f64>> {
        let first =
            |seed: &Seed| seed.rows.iter().find(|row| row.get("success_percentage") >= LEARNT).copied();
        self.seeds.iter().map(|seed| first(seed).map(|row| row.get("num_samples"))).collect()
    }

    /// Most steps of a seed, and hours of all of them.
    fn cost(&self) -> [f64; 2] {
        let last = self.seeds.iter().filter_map(|seed| seed.rows.last());
        let seconds = self.seeds.iter().flat_map(|seed| &seed.rows).map(|row| row.get("time"));
        [last.map(|row| row.get("num_samples")).fold(0.0, f64::max), seconds.sum::<f64>() / 3600.0]
    }
}

/// Runs the command.
pub fn run(a: &Report) -> Result<(), Failure> {
    a.html.as_deref().map_or(Ok(()), check_place)?;
    let groups = groups(a)?;
    let tasks: Vec<_> = groups.iter().map(Group::scores).collect();
    let seeds = tasks.iter().any(|scores| scores.len() > 1);
    let interval = seeds.then(|| bootstrap(&tasks, interquartile_mean, SEED));
    let overall = (interquartile_mean(&tasks.concat()), interval);
    if let Some(file) = &a.html {
        std::fs::write(file, page(&groups)).map_err(unwritable(file))?;
    }
    if a.json {
        show_json(&as_json(a, &groups, overall));
        return Ok(());
    }
    show!("{} episodes from seed {}, by mean actions", a.playing.episodes, a.playing.seed);
    show!(
        "{:>9}  {:>16}  {:>5}  {:>12}  {:>12}  {:>7}  {:>14}  run",
        "success",
        "95 % interval",
        "seeds",
        "steps",
        "90 % after",
        "hours",
        "zero, random"
    );
    for group in &groups {
        let [steps, hours] = group.cost();
        let interval = text(group.interval());
        let floors = format!("{:.0}, {:.0} %", group.floors[0], group.floors[1]);
        show!(
            "{:>7.1} %  {interval:>16}  {:>5}  {steps:>12}  {:>12}  {hours:>7.2}  {floors:>14}  {} {}",
            interquartile_mean(&group.scores()),
            group.seeds.len(),
            first(&group.learnt()),
            group.common.id,
            group.name()
        );
    }
    if groups.len() > 1 {
        let (mean, interval) = overall;
        show!("{mean:>7.1} %  {:>16}  the interquartile mean over all runs", text(interval));
    }
    if let Some(file) = &a.html {
        note(&format!("{} has the learning curves", file.display()));
    }
    Ok(())
}

/// An interval \[%\] in words.
fn text(interval: Option<[f64; 2]>) -> String {
    interval.map_or("-".into(), |[low, high]| format!("{low:.1} to {high:.1} %"))
}

/// The median of the steps after which seeds had learnt, in words where not all have.
fn first(learnt: &[Option<f64>]) -> String {
    let mut known: Vec<f64> = learnt.iter().flatten().copied().collect();
    known.sort_by(f64::total_cmp);
    match known.len() {
        0 => "never".into(),
        found if found == learnt.len() => known[found / 2].to_string(),
        found => format!("{found} of {}", learnt.len()),
    }
}

/// Reads the runs, and plays their policies and the floors.
fn groups(a: &Report) -> Result<Vec<Group>, Failure> {
    let mut groups: Vec<Group> = Vec::new();
    let bar = if a.quiet || a.json { ProgressBar::hidden() } else { ProgressBar::new(0) };
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} episodes, {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.inc_length(a.runs.len() as u64 * u64::from(a.playing.episodes));
    for folder in &a.runs {
        let config = Run::config_of(folder).map_err(Failure::usage)?;
        let rows = Run::rows_of(folder).map_err(Failure::usage)?;
        let policy = Policy::open(Run::policy_of(folder)).map_err(Failure::usage)?;
        let env = environment(a.making.clone(), &config)?;
        let success = |policy: &Policy| -> Result<f64, Failure> {
            let episodes = a.playing.play(&env, policy, &bar)?;
            Ok(evaluate(&episodes, env.success()).success_percentage)
        };
        // How long they were trained is no setting.
        let common = Config { seed: 0, iterations: 0, keep_every: 0, ..config.clone() };
        let place = match groups.iter().position(|group| group.common == common) {
            Some(place) => place,
            None => {
                let floors = match groups.iter().find(|group| is_one_environment(&group.common, &common)) {
                    Some(group) => group.floors,
                    None => {
                        bar.inc_length(2 * u64::from(a.playing.episodes));
                        [success(&Policy::Zero)?, success(&Policy::random(0))?]
                    }
                };
                groups.push(Group { common, own: BTreeMap::new(), seeds: Vec::new(), floors });
                groups.len() - 1
            }
        };
        let group = &mut groups[place];
        if group.seeds.iter().any(|seed| seed.config.seed == config.seed) {
            let message = format!(
                "{}: a run of {} by {} with seed {} is here already: leave one out",
                folder.display(),
                config.id,
                group.algorithm(),
                config.seed
            );
            return Err(Failure::usage(message));
        }
        group.seeds.push(Seed { success: success(&policy)?, config, rows });
    }
    bar.finish_and_clear();
    find_own(&mut groups)?;
    groups.sort_by(|a, b| (&a.common.id, a.name()).cmp(&(&b.common.id, b.name())));
    Ok(groups)
}

/// Whether two configurations have the same environment.
fn is_one_environment(a: &Config, b: &Config) -> bool {
    (&a.id, &a.compat, &a.solver, &a.environment) == (&b.id, &b.compat, &b.solver, &b.environment)
}

/// Finds what settings groups do not share with others of their environment and algorithm.
fn find_own(groups: &mut [Group]) -> Result<(), Failure> {
    let kind = |group: &Group| (group.common.id.clone(), group.algorithm());
    let all = groups
        .iter()
        .map(|group| Ok((kind(group), group.common.settings().map_err(Failure::usage)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    for (group, (kind, settings)) in groups.iter_mut().zip(&all) {
        let others = || all.iter().filter(|(other, _)| other == kind);
        let differs = |key: &str, value| others().any(|(_, other)| other.get(key) != Some(value));
        let own = settings.iter().filter(|(key, value)| differs(key, value));
        group.own = own.map(|(key, value)| (key.clone(), value.clone())).collect();
    }
    Ok(())
}

fn as_json(a: &Report, groups: &[Group], (mean, interval): (f64, Option<[f64; 2]>)) -> serde_json::Value {
    let rows = groups.iter().map(|group| {
        let [steps, hours] = group.cost();
        json!({
            "id": group.common.id,
            "algorithm": group.algorithm(),
            "settings": group.own,
            "seeds": group.seeds.iter().map(|seed| seed.config.seed).collect::<Vec<_>>(),
            "success_percentages": group.scores(),
            "interquartile_mean": interquartile_mean(&group.scores()),
            "interval": group.interval(),
            "num_samples": steps,
            "num_samples_to_90": group.learnt(),
            "hours": hours,
            "zero": group.floors[0],
            "random": group.floors[1],
        })
    });
    let scores: Vec<f64> = groups.iter().flat_map(Group::scores).collect();
    json!({
        "episodes": a.playing.episodes,
        "seed": a.playing.seed,
        "rows": rows.collect::<Vec<_>>(),
        "interquartile_mean": mean,
        "interval": interval,
        "profile": { "thresholds": THRESHOLDS, "shares": profile(&scores, &THRESHOLDS) },
    })
}

/// The table, and for each environment success over steps, a curve for each seed.
fn page(groups: &[Group]) -> String {
    let mut text = String::from(
        "<!DOCTYPE html><html lang=en><head><meta charset=utf-8><title>Runs</title><style>body{font:15px/1.45 \
         system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em}table{border-collapse:collapse}td,th{padding:.2em \
         .7em;border-bottom:1px solid #ddd;text-align:right}svg text{font-size:11px}</style></head><body><h1>Runs</h1><table>\
         <tr><th>environment</th><th>algorithm</th><th>success [%]</th><th>95 % interval</th><th>seeds</th><th>steps</th>\
         <th>zero [%]</th><th>random [%]</th></tr>",
    );
    for group in groups {
        let ([steps, _], interval) = (group.cost(), self::text(group.interval()));
        let mean = interquartile_mean(&group.scores());
        // Writing into a text cannot fail.
        let _ = write!(
            text,
            "<tr><td>{}</td><td>{}</td><td>{mean:.1}</td><td>{interval}</td><td>{}</td><td>{steps}</td>\
             <td>{:.1}</td><td>{:.1}</td></tr>",
            group.common.id,
            escaped(&group.name()),
            group.seeds.len(),
            group.floors[0],
            group.floors[1]
        );
    }
    text += "</table>";
    for (id, groups) in by_environment(groups) {
        let _ = write!(
            text,
            "<h2>{id}</h2><p>Success of an iteration's episodes [%], whose actions are drawn, over steps: "
        );
        let mut curves = Vec::new();
        for (group, colour) in groups.iter().zip(COLOURS.iter().cycle()) {
            let _ = write!(text, "<span style=\"color:{colour}\">&#9644; {}</span> ", escaped(&group.name()));
            curves.extend(group.seeds.iter().map(|seed| {
                Curve {
                    colour,
                    points: seed
                        .rows
                        .iter()
                        .map(|row| ["num_samples", "success_percentage"].map(|c| row.get(c)))
                        .collect(),
                }
            }));
        }
        text = text + "</p>" + &plot(&curves);
    }
    text + "</body></html>\n"
}

/// Text whose marks are no HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The groups of each environment.
fn by_environment(groups: &[Group]) -> BTreeMap<&str, Vec<&Group>> {
    let mut found: BTreeMap<&str, Vec<&Group>> = BTreeMap::new();
    groups.iter().for_each(|group| found.entry(&group.common.id).or_default().push(group));
    found
}
