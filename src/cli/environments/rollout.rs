//! `rollout`: replay recorded actions, or observe recorded states, for comparison with other implementations.

use crate::failure::{Failure, unwritable};
use crate::input::library::Source;
use crate::output::{archive_file, check_place, keep_input};
use crate::pictures::renderer::RendererArguments;
use crate::terminal::show;
use clap::{Args, ValueHint};
use dataset::npz::{NpzReader, NpzWriter};
use dataset::{Array, Values};
use env::{Env, Exteroception, Pixels, Rows, WorldState};
use std::path::{Path, PathBuf};

/// Replay recorded actions, or observe recorded states, and write all that the environment says
#[derive(Args)]
#[command(
    after_help = "Files are numpy archives. A.npz holds `actions` (T x action length) and may hold a first state: one \
row each of time, qpos, qvel, act, mocap_pos, mocap_quat, site_pos, site_quat, body_pos, body_quat. S.npz holds rows of \
these, and of `actions` (the last action before each state) or `ctrl` (the controls it became); every row is a state by \
itself. What is missing keeps its value after the reset.

O.npz holds, with T+1 rows of which the first is the reset (with --states one row a state): the state under the same names, \
obs, obs_dict/KEY, rwd_dict/KEY (all terms, dense, sparse, solved, done), with --visual visual_dict/KEY; and with T rows reward, terminated, truncated.

Examples:
  robohive rollout hive/FrankaReach-v0 --actions A.npz --out O.npz
  robohive rollout hive/FrankaReach-v0 --seed 3 --compat robohive-0.7 --states S.npz --out O.npz"
)]
pub struct Rollout {
    /// The environment
    #[command(flatten)]
    source: Source,
    /// Seed of the reset, as `env.seed(SEED)` before `env.reset()`
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Actions to replay
    #[arg(long, value_name = "A.npz", value_hint = ValueHint::FilePath, required_unless_present = "states")]
    actions: Option<PathBuf>,
    /// States to observe
    #[arg(long, value_name = "S.npz", value_hint = ValueHint::FilePath, conflicts_with = "actions")]
    states: Option<PathBuf>,
    /// Draw the images of the visual keys too
    #[arg(long)]
    visual: bool,
    /// What draws them
    #[command(flatten)]
    renderer: RendererArguments,
    /// File to write
    #[arg(long, value_name = "O.npz", value_hint = ValueHint::FilePath, value_parser = archive_file)]
    out: PathBuf,
}

/// Runs the command.
pub fn run(a: &Rollout) -> Result<(), Failure> {
    check_place(&a.out)?;
    [&a.actions, &a.states].into_iter().flatten().try_for_each(|input| keep_input(input, &a.out))?;
    let mut env = a.source.make_with(a.renderer.painters_if(a.visual, "--visual")?)?;
    env.reset(Some(a.seed)).map_err(Failure::new)?;
    let mut log = Log { visual: a.visual, ..Log::default() };
    match (&a.actions, &a.states) {
        (Some(path), _) => replay(&mut env, path, &mut log)?,
        (None, Some(path)) => observe(&mut env, path, &mut log)?,
        (None, None) => return Err(Failure::usage("--actions or --states is needed")),
    }
    let rows = log.write(&a.out)?;
    show!("{rows} states of {} written to {}", a.source.id, a.out.display());
    Ok(())
}

/// Arrays of one archive, as rows.
struct Columns {
    path: PathBuf,
    columns: Vec<(String, usize, Vec<f64>)>,
}

impl Columns {
    fn open(path: &Path) -> Result<Self, Failure> {
        let archive = NpzReader::open(path).map_err(Failure::usage)?;
        let names = WorldState::NAMES.iter().copied().chain(["actions"]);
        let mut columns = Vec::new();
        for name in names {
            if let Some(array) = archive.get(name).map_err(Failure::usage)? {
                columns.push((name.to_string(), array.rows(), array.values.to_f64()));
            }
        }
        Ok(Columns { path: path.into(), columns })
    }

    /// Row `row` of an array; `None` where there is no such array.
    fn row(&self, name: &str, row: usize) -> Option<&[f64]> {
        let (_, rows, values) = self.columns.iter().find(|(column, ..)| column == name)?;
        let width = values.len().checked_div(*rows)?;
        values.get(row * width..(row + 1) * width)
    }

    fn rows(&self, name: &str) -> Option<usize> {
        self.columns.iter().find(|(column, ..)| column == name).map(|(_, rows, _)| *rows)
    }

    fn world(&self, row: usize) -> WorldState {
        let mut world = WorldState::default();
        for name in WorldState::NAMES {
            if let Some(values) = self.row(name, row) {
                world.set(name, values);
            }
        }
        world
    }

    fn lacks(&self, what: &str) -> Failure {
        Failure::usage(format!("{} holds no {what}", self.path.display()))
    }
}

fn replay(env: &mut Env, path: &Path, log: &mut Log) -> Result<(), Failure> {
    let file = Columns::open(path)?;
    let steps = file.rows("actions").ok_or_else(|| file.lacks("actions"))?;
    let world = file.world(0);
    if world != WorldState::default() {
        env.set_world(&world).map_err(Failure::usage)?;
    }
    log.state(env)?;
    for step in 0..steps {
        let action = file.row("actions", step).ok_or_else(|| file.lacks("actions"))?;
        let outcome =
            env.step(action).map_err(|error| Failure::usage(format!("step {}: {error}", step + 1)))?;
        if let Some(fault) = &outcome.fault {
            return Err(Failure::new(format!("step {}: {fault}", step + 1)));
        }
        log.state(env)?;
        log.step("reward", outcome.reward);
        log.step("terminated", f64::from(outcome.terminated));
        log.step("truncated", f64::from(outcome.truncated));
    }
    Ok(())
}

fn observe(env: &mut Env, path: &Path, log: &mut Log) -> Result<(), Failure> {
    let file = Columns::open(path)?;
    let states =
        ["time", "qpos"].iter().find_map(|name| file.rows(name)).ok_or_else(|| file.lacks("time or qpos"))?;
    for state in 0..states {
        let mut world = file.world(state);
        if let (None, Some(action)) = (&world.ctrl, file.row("actions", state)) {
            world.ctrl = Some(
                env.controls_of(action).map_err(|error| Failure::usage(format!("row {state}: {error}")))?,
            );
        }
        env.set_world(&world).map_err(|error| Failure::usage(format!("row {state}: {error}")))?;
        log.state(env)?;
    }
    Ok(())
}

/// Columns in the order in which they first appear.
#[derive(Default)]
struct Log {
    columns: Vec<(String, usize, Vec<f64>)>,
    states: usize,
    /// Whether images are drawn.
    visual: bool,
    /// Images by their keys: the shape of one, and the values of all.
    images: Vec<(String, Vec<usize>, Pixels)>,
}

impl Log {
    fn push(&mut self, name: &str, values: &[f64]) {
        match self.columns.iter_mut().find(|(column, ..)| column == name) {
            Some((_, _, column)) => column.extend_from_slice(values),
            None => self.columns.push((name.into(), values.len(), values.to_vec())),
        }
    }

    /// A number for each step, without a second axis.
    fn step(&mut self, name: &str, value: f64) {
        match self.columns.iter_mut().find(|(column, ..)| column == name) {
            Some((_, _, column)) => column.push(value),
            None => self.columns.push((name.into(), 0, vec![value])),
        }
    }

    fn state(&mut self, env: &mut Env) -> Result<(), Failure> {
        if self.visual {
            self.draw(env.exteroception().map_err(Failure::usage)?);
        }
        env.world().parts().for_each(|(name, values)| self.push(name, &values));
        self.push("obs", env.observation());
        self.rows("obs_dict", env.rows());
        self.rows("rwd_dict", env.terms());
        let verdict = env.verdict();
        let verdicts = [
            ("dense", env.dense()),
            ("sparse", verdict.sparse),
            ("solved", f64::from(verdict.solved)),
            ("done", f64::from(verdict.done)),
        ];
        // A term may be called as a verdict, as `done` of RoboHive's walks: it is written once.
        for (name, value) in verdicts.into_iter().filter(|(name, _)| env.terms().get(name).is_none()) {
            self.push(&format!("rwd_dict/{name}"), &[value]);
        }
        self.states += 1;
        Ok(())
    }

    fn draw(&mut self, seen: &Exteroception) {
        self.push("visual_dict/time", &[seen.time()]);
        for image in seen.images() {
            let kept = self.images.iter_mut().find(|(name, ..)| name == image.name());
            match (kept.map(|(.., pixels)| pixels), image.pixels()) {
                (Some(Pixels::Bytes(kept)), Pixels::Bytes(bytes)) => kept.extend_from_slice(bytes),
                (Some(Pixels::Numbers(kept)), Pixels::Numbers(numbers)) => kept.extend_from_slice(numbers),
                (_, pixels) => {
                    self.images.push((image.name().into(), image.shape().to_vec(), pixels.clone()));
                }
            }
        }
    }

    fn rows(&mut self, folder: &str, rows: &Rows) {
        rows.iter().for_each(|(row, values)| self.push(&format!("{folder}/{}", row.name()), values));
    }

    /// Writes the archive; how many states it holds.
    fn write(self, path: &Path) -> Result<usize, Failure> {
        let mut archive = NpzWriter::create(path).map_err(unwritable(path))?;
        for (name, width, values) in self.columns {
            let rows = values.len().checked_div(width);
            let shape = rows.map_or_else(|| vec![values.len()], |rows| vec![rows, width]);
            let array = Array { shape, values: Values::F64(values) };
            archive.add(&name, &array).map_err(unwritable(path))?;
        }
        for (name, shape, pixels) in self.images {
            let shape = [&[self.states][..], &shape].concat();
            let values = match pixels {
                Pixels::Bytes(bytes) => Values::U8(bytes),
                Pixels::Numbers(numbers) => Values::F32(numbers),
            };
            archive
                .add(&format!("visual_dict/{name}"), &Array { shape, values })
                .map_err(unwritable(path))?;
        }
        archive.finish().map_err(unwritable(path))?;
        Ok(self.states)
    }
}
