//! `data export`: recordings as datasets of Minari and LeRobot.

use crate::failure::Failure;
use crate::recordings::names::PictureForm;
use crate::recordings::open::open;
use crate::terminal::{note, show};
use clap::{Args, Subcommand, ValueHint};
use dataset::trace::{TraceError, TraceReader};
use env::Registry;
use exchange::Exported;
use exchange::lerobot;
use exchange::minari::{self, DatasetId, env_spec};
use record::ID;
use std::path::{Path, PathBuf};

/// Write a recording as a dataset that Minari or LeRobot loads
#[derive(Args)]
#[command(
    after_help = "The recording has RoboHive's layout. A step of a dataset has the reward of the state that it leads to: that of the \
recording's next row.

Examples:
  robohive data export minari validation/reference/traces/robohive.h5 robohive/franka/random-v0 --root datasets
  robohive data export lerobot validation/reference/traces/robohive.h5 franka --pictures png"
)]
pub struct Export {
    #[command(subcommand)]
    to: Form,
}

#[derive(Subcommand)]
enum Form {
    /// A dataset for minari.load_dataset
    Minari(ToMinari),
    /// A dataset for LeRobotDataset, version 3.0
    Lerobot(ToLeRobot),
}

/// A dataset for minari.load_dataset
#[derive(Args)]
#[command(
    after_help = "Everything of the recording that has a row a state is kept, as infos; images without loss. The spaces have no \
limits: robohive.data.export_minari of the Python package takes those of an environment.

Examples:
  robohive data export minari validation/reference/traces/robohive.h5 robohive/franka/random-v0 --root datasets
  robohive data export minari validation/reference/traces/robohive.h5 franka-v1 --root datasets --no-infos"
)]
struct ToMinari {
    /// HDF5 file or numpy archive; - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Name of the dataset with its version, as robohive/door/random-v0
    #[arg(value_parser = DatasetId::new)]
    id: DatasetId,
    /// Folder of datasets [default: $MINARI_DATASETS_PATH, else ~/.minari/datasets]
    #[arg(long, value_hint = ValueHint::DirPath)]
    root: Option<PathBuf>,
    /// Keep observations, actions and rewards alone
    #[arg(long)]
    no_infos: bool,
}

/// A dataset for LeRobotDataset, version 3.0
#[derive(Args)]
#[command(
    after_help = "A frame is a step: observation.state, observation.images.CAMERA, action, next.reward, next.done, next.success. \
Numbers become float32. What has no place in a frame is named.

Examples:
  robohive data export lerobot validation/reference/traces/robohive.h5 franka --pictures png
  robohive data export lerobot validation/reference/traces/robohive.h5 franka10 --task \"reach the target\" --fps 10 --pictures png"
)]
struct ToLeRobot {
    /// HDF5 file or numpy archive; - for standard input
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Folder of the dataset, which must not exist
    #[arg(value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// What the episodes are attempts at, in words [default: the environment's id]
    #[arg(long)]
    task: Option<String>,
    /// The robot, in a word
    #[arg(long)]
    robot: Option<String>,
    /// Frames a second [default: as recorded]
    #[arg(long)]
    fps: Option<f64>,
    /// How pictures are kept
    #[arg(long, default_value = "video")]
    pictures: PictureForm,
}

/// Runs the command.
pub fn run(a: &Export) -> Result<(), Failure> {
    match &a.to {
        Form::Minari(a) => to_minari(a),
        Form::Lerobot(a) => to_lerobot(a),
    }
}

fn to_minari(a: &ToMinari) -> Result<(), Failure> {
    let trace = open(&a.file)?;
    let chosen = || std::env::var_os("MINARI_DATASETS_PATH").map(PathBuf::from);
    let home = || std::env::home_dir().map(|home| home.join(".minari/datasets"));
    let root = a.root.clone().or_else(chosen).or_else(home);
    let root =
        root.ok_or_else(|| Failure::usage("there is no home folder: --root says where datasets are"))?;
    let attributes = trace.attributes().map_err(Failure::usage)?;
    let id = attributes.iter().find(|(name, _)| name == ID).map(|(_, id)| id);
    let target = minari::Target {
        root,
        id: a.id.clone(),
        infos: !a.no_infos,
        spaces: [None, None],
        env_spec: id
            .map(|id| env_spec(id, Registry::builtin().spec(id).ok().map(|spec| spec.max_episode_steps))),
        more: serde_json::Map::new(),
    };
    tell(&trace, &target.root.join(a.id.as_str()), minari::export(&trace, &target, &mut |_, _| true))
}

fn to_lerobot(a: &ToLeRobot) -> Result<(), Failure> {
    let trace = open(&a.file)?;
    let target = lerobot::Target {
        root: a.out.clone(),
        task: a.task.clone(),
        robot: a.robot.clone(),
        frames_per_second: a.fps,
        pictures: a.pictures.into(),
    };
    tell(&trace, &a.out, lerobot::export(&trace, &target, &mut |_, _| true))
}

/// Says what came of an export to a place. Wrong input is the caller's fault, and so is a dataset that exists.
fn tell(trace: &TraceReader, place: &Path, done: Result<Exported, TraceError>) -> Result<(), Failure> {
    let done = done.map_err(|error| {
        let callers = error.path == trace.path() || error.path == place;
        if callers { Failure::usage(error) } else { Failure::new(error) }
    })?;
    done.dropped.iter().for_each(|(key, why)| note(&format!("not written: {key}: {why}")));
    show!("written      {}, {} episodes, {} steps", place.display(), done.episodes, done.steps);
    Ok(())
}
