//! Environments beside RoboHive's own Python: observations and rewards of recorded states, and what resets draw.
//!
//! `reference/robohive.py` records, for an id, a seeded reset, seeded actions, and every state visited with its observation
//! dictionary and reward terms. Here every recorded state is set, forwarded and observed, so that only the functions of the task are
//! compared, not the physics between states. The recorded action is taken before each, for what a task remembers or draws.
//! `draws/` beside the records holds further resets, with the numbers of the model that they drew.

use dataset::npz::NpzReader;
use env::{Compat, Env, EnvError, Folder, Options, Rows, WorldState};
use physics::Model;
use physics::model::GeomType;
use std::fmt::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Largest relative difference of a number that counts as agreement.
pub const TOLERANCE: f64 = 1e-6;

/// Numbers that MuJoCo 3.1.3, by which the original was recorded, computes otherwise than later versions do. They are not compared.
const CORRECTED: [Corrected; 3] = [
    // A tendon around a sphere whose side site is outside of it (the muscle RI2 of the hand) may jump into the sphere, which
    // 3.2.3 corrected.
    Corrected { ids: &["Reorient"], rows: &["mlen", "mvel", "mforce"], elements: 27..28 },
    // Contacts with height fields are others, and so are the forces that sensors of touch feel.
    Corrected { ids: &["ChaseTagP2"], rows: &["grf"], elements: 0..4 },
    // The inertia of meshes is computed otherwise, and its axes turn where two moments are nearly equal, as in round objects.
    Corrected {
        ids: &["MyoHandCup", "MyoHandPiggybank", "MyoHandWatch", "MyoHandWineglass"],
        rows: &["curr_obj_rot", "object", "dense"],
        elements: 0..4,
    },
];

/// Elements of rows that are not compared.
struct Corrected {
    /// Parts of the ids that have them.
    ids: &'static [&'static str],
    /// Names of rows and terms.
    rows: &'static [&'static str],
    elements: Range<usize>,
}

/// Elements of a row or term of an id that are not compared.
fn corrected(id: &str, row: &str) -> Vec<usize> {
    let applies = |c: &&Corrected| c.rows.contains(&row) && c.ids.iter().any(|part| id.contains(part));
    CORRECTED.iter().filter(applies).flat_map(|c| c.elements.clone()).collect()
}

/// How far an id is from its record.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The id.
    pub id: String,
    /// States compared.
    pub states: usize,
    /// Largest difference of an observation, and its key.
    pub observation: Worst,
    /// Largest difference of a reward term, and its name.
    pub reward: Worst,
    /// Largest difference of the state after the seeded reset, and its part.
    pub draws: Worst,
    /// Keys that only one side has.
    pub keys: Vec<String>,
    /// Why nothing could be compared.
    pub error: Option<String>,
}

/// The largest difference seen, relative to the larger of 1 and the recorded number.
#[derive(Clone, Debug, Default)]
pub struct Worst {
    /// The difference.
    pub difference: f64,
    /// Where it was.
    pub place: String,
}

impl Worst {
    fn see(&mut self, place: impl Fn() -> String, ours: &[f64], recorded: &[f64]) {
        self.see_except(place, ours, recorded, &[]);
    }

    /// The same without some elements.
    fn see_except(&mut self, place: impl Fn() -> String, ours: &[f64], recorded: &[f64], skip: &[usize]) {
        if ours.len() != recorded.len() {
            *self = Worst {
                difference: f64::INFINITY,
                place: format!("{} ({} values, not {})", place(), ours.len(), recorded.len()),
            };
            return;
        }
        let pairs = ours.iter().zip(recorded).enumerate();
        for (k, (&ours, &recorded)) in pairs.filter(|(k, _)| !skip.contains(k)) {
            let both_nan = ours.is_nan() && recorded.is_nan();
            let difference = if both_nan { 0.0 } else { (ours - recorded).abs() / recorded.abs().max(1.0) };
            if difference.is_nan() || difference > self.difference {
                *self = Worst { difference, place: format!("{}[{k}]: {ours} not {recorded}", place()) };
            }
        }
    }

    fn holds(&self) -> bool {
        self.difference <= TOLERANCE
    }
}

/// A record: its arrays by name, rows of numbers.
struct Record {
    id: String,
    archive: NpzReader,
}

impl Record {
    fn open(path: &Path) -> Result<Self, String> {
        let archive = NpzReader::open(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let id = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Record { id, archive })
    }

    /// Row `row` of an array; `None` where the record has no such array.
    fn row(&self, name: &str, row: usize) -> Result<Option<Vec<f64>>, String> {
        let Some(array) = self.archive.get(name).map_err(|error| error.to_string())? else { return Ok(None) };
        let width = array.values.len() / array.rows().max(1);
        // What never changes is recorded once.
        let row = row.min(array.rows().saturating_sub(1));
        Ok(Some(array.values.to_f64()[row * width..(row + 1) * width].to_vec()))
    }

    fn world(&self, row: usize) -> Result<WorldState, String> {
        let mut world = WorldState::default();
        for name in WorldState::NAMES {
            if let Some(values) = self.row(name, row)? {
                world.set(name, &values);
            }
        }
        // What the robot last sent is no state of the simulation.
        world.last_ctrl = self.row("extra/last_ctrl", row)?;
        Ok(world)
    }

    fn keys(&self, folder: &str) -> Vec<String> {
        self.archive.names().filter_map(|name| name.strip_prefix(folder)).map(String::from).collect()
    }
}

/// Compares the environment of every record in a folder, those whose id contains `only`.
///
/// # Errors
/// The folder cannot be read.
pub fn compare(assets: &Path, records: &Path, only: &str) -> Result<Vec<Row>, String> {
    let entries = std::fs::read_dir(records).map_err(|error| format!("{}: {error}", records.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "npz"));
    paths.sort();
    let mut rows = Vec::new();
    for path in paths {
        let id = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !id.contains(only) {
            continue;
        }
        let row =
            one(&id, assets, &path).unwrap_or_else(|error| Row { id, error: Some(error), ..Row::default() });
        println!("{}", row.line());
        rows.push(row);
    }
    Ok(rows)
}

fn one(id: &str, assets: &Path, path: &Path) -> Result<Row, String> {
    let record = Record::open(path)?;
    let mut row = Row { id: id.into(), ..Row::default() };
    let seed = record.row("seed", 0)?.and_then(|seed| seed.first().copied()).ok_or("no seed")?;
    let mut environment = make(id, assets, seed)?;
    environment.reset(Some(seed as u64)).map_err(|error| error.to_string())?;
    compare_draws(&environment, &record, 0, &mut row)?;
    let draws = path.with_file_name("draws").join(path.file_name().unwrap_or_default());
    if draws.is_file() {
        compare_resets(id, assets, &Record::open(&draws)?, &mut row)?;
    }
    let states = record.archive.require("time").map_err(|error| error.to_string())?.rows();
    for state in 0..states {
        if let Some(action) = (state > 0).then(|| record.row("actions", state - 1)).transpose()?.flatten() {
            environment.step(&action).map_err(|error| format!("step {state}: {error}"))?;
            compare_model(&environment, &record, state, &mut row.draws)?;
        }
        let world = record.world(state)?;
        environment.set_world(&world).map_err(|error: EnvError| format!("state {state}: {error}"))?;
        let verdict = environment.verdict();
        compare_rows(environment.rows(), &record, "obs_dict/", state, &mut row.observation, &mut row.keys)?;
        // A reset of the original may start again and still return what it observed first.
        let repeated = state == 0 && record.row("obs", 0)? != gathered(&environment, &record)?;
        if let (false, Some(recorded)) = (repeated, record.row("obs", state)?) {
            let place = || format!("obs at {state}");
            row.observation.see_except(place, environment.observation(), &recorded, &skipped(&environment));
        }
        compare_rows(environment.terms(), &record, "rwd_dict/", state, &mut row.reward, &mut row.keys)?;
        let flag = |set| if set { 1.0 } else { 0.0 };
        for (name, ours) in [
            ("dense", environment.dense()),
            ("sparse", verdict.sparse),
            ("solved", flag(verdict.solved)),
            ("done", flag(verdict.done)),
        ] {
            if let Some(recorded) = record.row(&format!("rwd_dict/{name}"), state)? {
                let place = || format!("{name} at {state}");
                row.reward.see_except(place, &[ours], &recorded, &corrected(id, name));
            }
        }
        row.states += 1;
    }
    Ok(row)
}

/// The recorded rows of the first state that make an observation vector.
fn gathered(environment: &Env, record: &Record) -> Result<Option<Vec<f64>>, String> {
    let rows = environment.obs_keys().iter().map(|key| record.row(&format!("obs_dict/{key}"), 0));
    let rows: Option<Vec<_>> = rows.collect::<Result<_, String>>()?;
    Ok(rows.map(|rows| rows.concat()))
}

/// The environment of an id, made with this seed.
fn make(id: &str, assets: &Path, seed: f64) -> Result<Env, String> {
    let options = Options::default().with_seed(seed as u64).with_compat(Compat::RoboHive07);
    Env::make(id, &Folder::new(assets), &options).map_err(|error| error.to_string())
}

/// Resets beside those recorded: for every seed an environment made with it, then seeded with it and reset as often as recorded.
fn compare_resets(id: &str, assets: &Path, record: &Record, row: &mut Row) -> Result<(), String> {
    let resets = record.archive.require("seed").map_err(|error| error.to_string())?.rows();
    let mut current: Option<(f64, Env)> = None;
    for reset in 0..resets {
        let seed = record.row("seed", reset)?.and_then(|seed| seed.first().copied()).ok_or("no seed")?;
        let (_, environment) = match current.take() {
            Some((last, mut environment)) if last == seed => {
                environment.reset(None).map_err(|error| error.to_string())?;
                (last, environment)
            }
            _ => {
                let mut environment = make(id, assets, seed)?;
                environment.reset(Some(seed as u64)).map_err(|error| error.to_string())?;
                (seed, environment)
            }
        };
        compare_draws(&environment, record, reset, row)?;
        current = Some((seed, environment));
    }
    Ok(())
}

/// Elements of the observation vector that are not compared.
fn skipped(environment: &Env) -> Vec<usize> {
    let mut start = 0;
    let mut skipped = Vec::new();
    for key in environment.obs_keys() {
        skipped.extend(corrected(&environment.spec().id, key).into_iter().map(|element| start + element));
        start += environment.rows().get(key).map_or(0, <[f64]>::len);
    }
    skipped
}

/// Rows of a state beside those recorded. Names that only one side has are noted once.
fn compare_rows(
    rows: &Rows,
    record: &Record,
    folder: &str,
    state: usize,
    worst: &mut Worst,
    keys: &mut Vec<String>,
) -> Result<(), String> {
    for (row, values) in rows.iter() {
        match record.row(&format!("{folder}{}", row.name()), state)? {
            Some(recorded) => {
                let place = || format!("{} at {state}", row.name());
                worst.see_except(place, values, &recorded, &corrected(&record.id, row.name()));
            }
            None if state == 0 => keys.push(format!("{folder}{} is not recorded", row.name())),
            None => {}
        }
    }
    if state == 0 {
        let verdicts = ["dense", "sparse", "solved", "done"];
        let missing = record.keys(folder).into_iter().filter(|key| {
            rows.get(key).is_none() && !(folder == "rwd_dict/" && verdicts.contains(&key.as_str()))
        });
        keys.extend(missing.map(|key| format!("{folder}{key} is missing here")));
    }
    Ok(())
}

/// The state after a reset beside the recorded one: what was drawn.
fn compare_draws(environment: &Env, record: &Record, reset: usize, row: &mut Row) -> Result<(), String> {
    let (ours, recorded) = (environment.world(), record.world(reset)?);
    let parts = [
        ("qpos", &ours.qpos, &recorded.qpos),
        ("qvel", &ours.qvel, &recorded.qvel),
        ("mocap_pos", &ours.mocap_pos, &recorded.mocap_pos),
        ("mocap_quat", &ours.mocap_quat, &recorded.mocap_quat),
        ("site_pos", &ours.site_pos, &recorded.site_pos),
        ("site_quat", &ours.site_quat, &recorded.site_quat),
        ("body_pos", &ours.body_pos, &recorded.body_pos),
        ("body_quat", &ours.body_quat, &recorded.body_quat),
    ];
    for (name, ours, recorded) in parts {
        if let (Some(ours), Some(recorded)) = (ours, recorded) {
            row.draws.see(|| format!("{name} at {reset}"), ours, recorded);
        }
    }
    compare_model(environment, record, reset, &mut row.draws)?;
    // What a reset draws without moving anything shows in the observation.
    compare_rows(environment.rows(), record, "obs_dict/", reset, &mut row.draws, &mut Vec::new())
}

/// Numbers of the model beside those recorded with a state.
fn compare_model(environment: &Env, record: &Record, state: usize, worst: &mut Worst) -> Result<(), String> {
    let mut result = Ok(());
    let model = &environment.scene().model;
    model.visit(&mut |name, _, values| {
        // Colours and the size of marks show success; nothing else follows from them.
        if ["geom_rgba", "site_rgba", "site_size"].contains(&name) {
            return;
        }
        match record.row(&format!("model/{name}"), state) {
            Ok(Some(recorded)) => {
                let ours = values.to_f64();
                let place = || format!("{name} at {state}");
                if name.starts_with("geom_") {
                    worst.see(place, &shapes(model, &ours), &shapes(model, &recorded));
                } else {
                    worst.see(place, &ours, &recorded);
                }
            }
            Ok(None) => {}
            Err(error) => result = Err(error),
        }
    });
    result
}

/// The rows of geoms that are no meshes: frames and sizes of meshes depend on how their inertia is computed.
fn shapes(model: &Model, values: &[f64]) -> Vec<f64> {
    let width = values.len() / model.ngeom.max(1);
    let rows = values.chunks(width.max(1)).zip(&model.geom_type);
    rows.filter(|&(_, &kind)| kind != GeomType::Mesh as i32).flat_map(|(row, _)| row).copied().collect()
}

impl Row {
    /// Whether observations, rewards and draws are the recorded ones.
    pub fn holds(&self) -> bool {
        self.error.is_none()
            && self.observation.holds()
            && self.reward.holds()
            && self.draws.holds()
            && self.states > 0
    }

    /// The row as one line, with what differs.
    pub fn line(&self) -> String {
        if let Some(error) = &self.error {
            return format!("{:<40} {error}", self.id);
        }
        let mut line = format!(
            "{:<40} {:>3} states  obs {:.1e}  rewards {:.1e}  draws {:.1e}",
            self.id, self.states, self.observation.difference, self.reward.difference, self.draws.difference
        );
        for (what, worst) in [("obs", &self.observation), ("reward", &self.reward), ("draws", &self.draws)] {
            if !worst.holds() {
                let _ = write!(line, "\n    {what}: {}", worst.place);
            }
        }
        self.keys.iter().for_each(|key| _ = write!(line, "\n    {key}"));
        line
    }
}

/// The table, and an error when a row differs.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut text = String::from("| id | states | observations | rewards | draws |\n|---|---|---|---|---|\n");
    for row in rows {
        let cell = |worst: &Worst| {
            if row.error.is_some() { "–".into() } else { format!("{:.0e}", worst.difference) }
        };
        let (observation, reward, draws) = (cell(&row.observation), cell(&row.reward), cell(&row.draws));
        let _ = writeln!(text, "| `{}` | {} | {observation} | {reward} | {draws} |", row.id, row.states);
    }
    let held = rows.iter().filter(|row| row.holds()).count();
    let _ = writeln!(text, "\n{held} of {} ids agree within {TOLERANCE:.0e}.", rows.len());
    let verdict = if held == rows.len() && held > 0 {
        Ok(())
    } else {
        Err(format!("{} ids differ", rows.len() - held))
    };
    (text, verdict)
}

/// What RoboHive does otherwise than it means to, as tables.
pub fn quirk_table() -> String {
    let mut text = String::from("## Robot\n\n");
    text.push_str(&robot::Quirk::table(robot::QUIRKS));
    text.push_str("\n## Tasks\n\n| name | ids | RoboHive 0.7, and here with `robohive-0.7` | here |\n|---|---|---|---|\n");
    for quirk in env::suite::quirks::quirks() {
        let ids: Vec<_> = quirk.ids.iter().map(|id| format!("`{id}`")).collect();
        let _ =
            writeln!(text, "| {} | {} | {} | {} |", quirk.name, ids.join(", "), quirk.original, quirk.fixed);
    }
    text
}
