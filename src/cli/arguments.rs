//! Arguments of every command, and the help that teaches them.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// Robots described in MJCF, moved as MuJoCo 3.12 moves them.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit codes: 0 done, 1 the work failed or a comparison disagreed, 2 wrong arguments or input.
Examples:
  robohive inspect assets/franka/franka_table.xml
  robohive sim assets/pile/pile.xml --seconds 2 --out pile.npz
  robohive check assets/elbow/elbow.xml validation/reference/own/elbow.npz"
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Subcommand)]
pub enum Command {
    /// Summarise a model, or write out every compiled array
    Inspect(Inspect),
    /// Compile a model into one file that loads in milliseconds
    Compile(Compile),
    /// Simulate a model with zero or keyframe controls
    Sim(Sim),
    /// Step or forward recorded inputs and write the named fields
    Trace(Trace),
    /// Compare a model with what MuJoCo recorded of it
    Check(Check),
    /// Measure steps per second
    Bench(Bench),
}

/// An MJCF file, and what its template text stands for; or a compiled model.
#[derive(Args)]
pub struct ModelSource {
    /// MJCF file, or what `compile` made of one
    #[arg(value_name = "MODEL")]
    pub path: PathBuf,
    /// How it is read
    #[command(flatten)]
    pub reading: Reading,
}

/// How models are read.
#[derive(Args)]
pub struct Reading {
    /// Replace TEXT by VALUE in the file and all it includes, e.g. OBJECT_NAME=apple
    #[arg(long = "define", value_name = "TEXT=VALUE")]
    pub defines: Vec<String>,
    /// Keep compiled models in this folder, and take them from there while no file they are made of has changed
    /// [default: the environment variable ROBOHIVE_CACHE, else none are kept]
    #[arg(long, value_name = "FOLDER")]
    pub cache: Option<PathBuf>,
}

/// Summarise a model, or write out every compiled array.
#[derive(Args)]
#[command(after_help = "Examples:
  robohive inspect model.xml                  sizes, options, bodies
  robohive inspect model.xml --npz model.npz  every array under its MuJoCo name and shape
  robohive inspect model.xml --json | jq .sizes")]
pub struct Inspect {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Write every model array to this numpy archive
    #[arg(long, value_name = "FILE")]
    pub npz: Option<PathBuf>,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

/// Compile a model into one file.
#[derive(Args)]
#[command(
    after_help = "The file holds all arrays, meshes and textures included, bit for bit; every command takes it as MODEL. A version of
robohive with other arrays refuses it: compile the text again.

Example:
  robohive compile assets/franka/franka_table.xml --out franka.rhm
  robohive sim franka.rhm --seconds 2"
)]
pub struct Compile {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// File to write
    #[arg(long, value_name = "FILE.rhm")]
    pub out: PathBuf,
}

/// Simulate a model.
#[derive(Args)]
#[command(after_help = "Example:
  robohive sim assets/franka/franka_table.xml --seconds 2 --keyframe ready --out run.npz
  python -c \"import numpy; print(numpy.load('run.npz')['qpos'].shape)\"")]
pub struct Sim {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Simulated time [s]
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    pub seconds: f64,
    /// Start from this keyframe, by name or number (default: the first, if any)
    #[arg(long)]
    pub keyframe: Option<String>,
    /// Write time, qpos, qvel, act, ctrl, sensordata and energy of every step
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// No progress on standard error
    #[arg(long, short)]
    pub quiet: bool,
}

/// Step or forward recorded inputs.
#[derive(Args)]
#[command(
    after_help = "IN holds any of qpos, qvel, act, ctrl, mocap_pos, mocap_quat, qfrc_applied, xfrc_applied, eq_active,
qacc_warmstart, time, one row a step or state; what it leaves out takes the value of a plain reset.
By default the rollout starts from row 0 and takes one row of ctrl a step; the fields are written after every step.
With --forward every row is an independent state and the fields of its forward pass are written; fields whose length
varies are concatenated in row order, and ncon and nefc tell the split. Contacts are contact.dist, contact.pos, ...

Examples:
  robohive trace model.xml --in controls.npz --out motion.npz --fields qpos,qvel,sensordata
  robohive trace model.xml --in states.npz --out forward.npz --forward --fields qacc,efc_J,contact.dist"
)]
pub struct Trace {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Numpy archive with inputs
    #[arg(long = "in", value_name = "IN.npz")]
    pub input: PathBuf,
    /// Numpy archive to write
    #[arg(long, value_name = "OUT.npz")]
    pub out: PathBuf,
    /// Fields to write, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "time,qpos,qvel,act")]
    pub fields: Vec<String>,
    /// Treat every row as an independent state
    #[arg(long)]
    pub forward: bool,
}

/// Compare a model with what MuJoCo recorded of it.
#[derive(Args)]
#[command(after_help = "The reference is written by validation/reference/record.py.
Example:
  robohive check assets/quadruped/quadruped.xml validation/reference/own/quadruped.npz")]
pub struct Check {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Recorded reference
    pub reference: PathBuf,
}

/// Measure steps per second.
#[derive(Args)]
#[command(
    after_help = "Starts from keyframe 0 where there is one, else qpos0, with zero controls; the time of loading is told apart.
Examples:
  robohive bench assets/*/*.xml --steps 2000 --json | tail -n 1
  robohive bench assets/pile/pile.xml --batch 64 --threads 2   many environments together
  robohive bench assets/pile/pile.xml --stages                 where the time of a step goes
  robohive bench assets/pile/pile.xml --jitter --steps 10000   p99.9 of the time of a step beside the median"
)]
pub struct Bench {
    /// MJCF files or compiled models
    #[arg(required = true)]
    pub models: Vec<PathBuf>,
    /// How they are read
    #[command(flatten)]
    pub reading: Reading,
    /// Steps of each environment
    #[arg(long, default_value_t = 1000)]
    pub steps: usize,
    /// Threads that step the environments
    #[arg(long, default_value_t = 1)]
    pub threads: usize,
    /// Environments (default: one a thread)
    #[arg(long)]
    pub batch: Option<usize>,
    /// Archive with rows of controls, array ctrl, or a recorded reference; after the last row all begins anew
    #[arg(long, value_name = "FILE.npz")]
    pub controls: Option<PathBuf>,
    /// Steps that a row of controls holds; there a batch waits for all its environments
    #[arg(long, default_value_t = 10)]
    pub hold: usize,
    /// Mean time of each stage of a step
    #[arg(long, conflicts_with_all = ["threads", "batch"])]
    pub stages: bool,
    /// Quantiles of the time of single steps
    #[arg(long, conflicts_with_all = ["threads", "batch", "stages"])]
    pub jitter: bool,
    /// Measure what standard input asks for, lines "rate N", "stages N" or "jitter N", for one model
    #[arg(long, conflicts_with_all = ["stages", "jitter"])]
    pub requests: bool,
    /// Print one JSON object a model; the last line is the last model's
    #[arg(long)]
    pub json: bool,
}
