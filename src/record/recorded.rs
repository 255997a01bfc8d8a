//! Trials of a recording, as a replay needs them.

use crate::error::RecordError;
use crate::{LOOK, MECHANICS, SEED, STATE};
use dataset::trace::{Entry, Layout, TraceError, TraceReader};
use dataset::{Dtype, F16, Values};
use env::{Env, EnvError, Rows, WorldState};

/// A dataset of numbers: rows, each of the same width.
pub struct Column {
    width: usize,
    dtype: Dtype,
    values: Vec<f64>,
}

impl Column {
    /// A row; `None` behind the last.
    pub fn row(&self, row: usize) -> Option<&[f64]> {
        self.values.get(row * self.width..(row + 1) * self.width)
    }

    fn rows(&self) -> usize {
        self.values.len().checked_div(self.width).unwrap_or(0)
    }

    /// The last row.
    pub fn last(&self) -> Option<&[f64]> {
        self.row(self.rows().checked_sub(1)?)
    }

    /// Two columns side by side, as far as both have rows.
    fn beside(self, other: &Column) -> Column {
        let pairs = self.values.chunks(self.width.max(1)).zip(other.values.chunks(other.width.max(1)));
        let values = pairs.flat_map(|(a, b)| a.iter().chain(b).copied()).collect();
        Column { width: self.width + other.width, dtype: self.dtype, values }
    }
}

/// What a replay needs of a trial.
pub struct Recorded {
    /// Seed of its reset.
    pub seed: Option<u64>,
    roboset: bool,
    /// Actions; the last row may be NaN.
    pub actions: Column,
    /// Parts of the states by name; RoboSet's qpos and qvel are the first values of the environment's.
    state: Vec<(&'static str, Column)>,
    /// Observation vectors.
    pub observations: Option<Column>,
    /// Rewards, one a row.
    pub rewards: Option<Column>,
    /// What the reset drew of the look and of the physics of the scene, by name.
    look: Drawn,
    mechanics: Drawn,
}

/// Names and values of what was drawn.
type Drawn = Vec<(String, Vec<f64>)>;

impl Recorded {
    /// Reads a trial of either layout.
    ///
    /// # Errors
    /// The file is damaged, or there are no actions.
    pub fn read(trace: &TraceReader, trial: &str) -> Result<Self, RecordError> {
        let source = Source { trace, entries: trace.entries(trial)? };
        let roboset = trace.layout(trial)? == Some(Layout::RoboSet);
        let mut state = Vec::new();
        for name in WorldState::NAMES {
            let column = match name {
                "qpos" if roboset => source.arm_and_hand("qp")?,
                "qvel" if roboset => source.arm_and_hand("qv")?,
                "time" if roboset => source.column("data/time")?,
                _ => source.column(&format!("{}{name}", STATE))?,
            };
            state.extend(column.map(|column| (name, column)));
        }
        let actions = if roboset { source.arm_and_hand("ctrl")? } else { source.column("actions")? };
        let actions = actions.ok_or_else(|| {
            let key = if roboset { "data/ctrl_arm" } else { "actions" };
            TraceError::new(trace.path(), trial, format!("no {key} to replay"))
        })?;
        Ok(Recorded {
            seed: source.seed(if roboset { "config/seed" } else { SEED })?,
            roboset,
            actions,
            state,
            observations: source.column("observations")?,
            rewards: source.column("rewards")?,
            look: source.drawn(LOOK)?,
            mechanics: source.drawn(MECHANICS)?,
        })
    }

    /// A part of the states.
    pub fn part(&self, name: &str) -> Option<&Column> {
        self.state.iter().find(|(part, _)| *part == name).map(|(_, column)| column)
    }

    /// Gives an environment the physics and the look that the recorded reset drew, where its own reset drew others; whether it did.
    ///
    /// # Errors
    /// The environment draws other things.
    pub fn restore_drawn(&self, env: &mut Env) -> Result<bool, EnvError> {
        let mechanics = other_draws(&self.mechanics, env.mechanics(), "physics_randomization")?;
        let look = other_draws(&self.look, env.look(), "visual_randomization")?;
        mechanics.as_ref().map_or(Ok(()), |drawn| env.set_mechanics(drawn))?;
        look.as_ref().map_or(Ok(()), |drawn| env.set_look(drawn))?;
        Ok(mechanics.is_some() || look.is_some())
    }

    /// The first recorded state, where it differs from the environment's own by more than its precision. What the
    /// recording lacks stays as it is.
    pub fn start(&self, env: &Env) -> Option<WorldState> {
        let mut world = WorldState::default();
        let mut differs = false;
        for (name, own) in env.world().parts() {
            let Some(column) = self.part(name) else { continue };
            let Some(recorded) = column.row(0) else { continue };
            let equal = |(&own, &recorded): (&f64, &f64)| kept(own, column.dtype) == recorded;
            let covered = recorded.len() == own.len() || self.roboset;
            differs |= !covered || !own.iter().zip(recorded).all(equal);
            // A state of another length is handed on, to be refused by name.
            let rest = if self.roboset { own.get(recorded.len()..).unwrap_or_default() } else { &[] };
            world.set(name, &[recorded, rest].concat());
        }
        differs.then_some(world)
    }
}

/// The datasets of a trial.
struct Source<'a> {
    trace: &'a TraceReader,
    entries: Vec<Entry>,
}

impl Source<'_> {
    fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    fn column(&self, key: &str) -> Result<Option<Column>, RecordError> {
        let Some(entry) = self.entry(key) else { return Ok(None) };
        let array = self.trace.read(entry)?;
        let width = array.shape.iter().skip(1).product();
        Ok(Some(Column { width, dtype: array.values.dtype(), values: array.values.to_f64() }))
    }

    /// All that stands below a name.
    fn drawn(&self, folder: &str) -> Result<Drawn, RecordError> {
        let below = self.entries.iter().filter_map(|entry| Some((entry, entry.key.strip_prefix(folder)?)));
        below.map(|(entry, name)| Ok((name.to_owned(), self.trace.read(entry)?.values.to_f64()))).collect()
    }

    /// RoboSet's columns of arm and hand side by side.
    fn arm_and_hand(&self, part: &str) -> Result<Option<Column>, RecordError> {
        let arm = self.column(&format!("data/{part}_arm"))?;
        let hand = self.column(&format!("data/{part}_ee"))?;
        Ok(match (arm, hand) {
            (Some(arm), Some(hand)) => Some(arm.beside(&hand)),
            (arm, _) => arm,
        })
    }

    /// A seed, in all its bits.
    fn seed(&self, key: &str) -> Result<Option<u64>, RecordError> {
        let Some(entry) = self.entry(key) else { return Ok(None) };
        match self.trace.read(entry)?.values {
            Values::U64(seeds) if seeds.len() == 1 => Ok(Some(seeds[0])),
            other => {
                let wrong = format!("a seed is one uint64, and here is {}", other.dtype().name());
                Err(TraceError::new(self.trace.path(), entry.path(), wrong).into())
            }
        }
    }
}

/// What was recorded, in the order of an environment's own draws; `None` where it drew the same.
fn other_draws(recorded: &Drawn, own: Option<&Rows>, setting: &str) -> Result<Option<Rows>, EnvError> {
    if recorded.is_empty() {
        return Ok(None);
    }
    let foreign =
        |what: String| EnvError::ForeignState { message: format!("the recording's {setting} {what}") };
    let own = own.ok_or_else(|| foreign("is not among the settings of this environment".into()))?;
    let mut values = Vec::new();
    for (row, _) in own.iter() {
        let drawn = recorded.iter().find(|(name, drawn)| name == row.name() && drawn.len() == row.len());
        let (_, drawn) =
            drawn.ok_or_else(|| foreign(format!("has no row {}, which is drawn here", row.name())))?;
        values.extend(drawn);
    }
    let mut drawn = own.clone();
    drawn.assign(&values);
    Ok((&drawn != own).then_some(drawn))
}

/// A number as a dataset of a type holds it.
fn kept(x: f64, dtype: Dtype) -> f64 {
    match dtype {
        Dtype::F16 => F16::from_f64(x).to_f64(),
        Dtype::F32 => f64::from(x as f32),
        _ => x,
    }
}
