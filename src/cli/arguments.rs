//! Arguments of every command, and the help that teaches them.

use crate::bench_env::BenchEnv;
use crate::bench_render::BenchRender;
use crate::check_env::CheckEnv;
use crate::convert::Convert;
use crate::film::FilmArguments;
use crate::gallery::Gallery;
use crate::info::Info;
use crate::list::List;
use crate::render::Render;
use crate::rollout::Rollout;
use crate::run::Run;
use clap::{Args, Parser, Subcommand, ValueHint, value_parser};
use std::path::PathBuf;

/// The version of MuJoCo whose motion is followed.
macro_rules! mujoco {
    () => {
        "3.12.0"
    };
}

/// Version of MuJoCo that the physics follows.
pub const MUJOCO: &str = mujoco!();

/// Version, commit where it is known, and version of MuJoCo.
pub const VERSION: &str =
    concat!(env!("CARGO_PKG_VERSION"), " (", env!("ROBOHIVE_FOLLOWS"), " MuJoCo ", mujoco!(), ")");

/// Most steps that one run takes.
pub const MAX_STEPS: u64 = 1_000_000_000;

/// Most threads of a batch.
const MAX_THREADS: i64 = 1024;

/// Most environments of a batch.
const MAX_ENVIRONMENTS: i64 = 1 << 20;

/// Robots described in MJCF, moved as MuJoCo 3.12 moves them.
#[derive(Parser)]
#[command(
    name = "robohive",
    version = VERSION,
    max_term_width = 100,
    after_help = "Exit codes: 0 done; 1 the work failed or a comparison disagreed; 2 wrong arguments \
or input; 130 interrupted by Ctrl-C (128 + the signal).

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
    /// List environments
    List(List),
    /// Describe an environment: spaces, rewards, model
    Info(Info),
    /// Play episodes of an environment
    Run(Run),
    /// Draw a model or an environment
    Render(Render),
    /// Draw many environments on one sheet
    Gallery(Gallery),
    /// Replay recorded actions or states in an environment
    Rollout(Rollout),
    /// Measure environment steps per second
    BenchEnv(BenchEnv),
    /// Measure how long pictures of a model take
    BenchRender(BenchRender),
    /// Check that environments keep their contract
    CheckEnv(CheckEnv),
    /// Summarise a model, or write out every compiled array
    Inspect(Inspect),
    /// Compile a model into one file that loads in milliseconds
    Compile(Compile),
    /// Write a model as one MJCF file that compiles to the same arrays
    Convert(Convert),
    /// Simulate a model under the controls of a keyframe, or none
    Sim(Sim),
    /// Step or forward recorded inputs and write the named fields
    Trace(Trace),
    /// Compare a model with what MuJoCo recorded of it
    Check(Check),
    /// Measure steps per second
    Bench(Bench),
    /// Keep the model files of RoboHive: import, list and verify them
    Assets(crate::assets::Assets),
    /// Look into recordings of episodes, repair them, convert them
    Data(crate::data::Data),
    /// Print completions for a shell
    Completions(Completions),
    /// Print or write manual pages
    Man(Man),
}

/// An MJCF file, and what its template text stands for; or a compiled model.
#[derive(Args)]
pub struct ModelSource {
    /// MJCF file, or a model written by `compile`; - for standard input
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub path: PathBuf,
    /// How it is read
    #[command(flatten)]
    pub reading: Reading,
}

/// How models are read.
#[derive(Args)]
pub struct Reading {
    /// Replace TEXT by VALUE in the file and all it includes, e.g. OBJECT_NAME=apple; TEXT must occur
    #[arg(long = "define", value_name = "TEXT=VALUE")]
    pub defines: Vec<String>,
    /// Keep compiled models in this folder, and take them from there while none of their input files has changed
    /// [default: the environment variable ROBOHIVE_CACHE, else none are kept]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub cache: Option<PathBuf>,
    /// Memory that the model may ask for, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 2048, value_parser = clap::value_parser!(u32).range(1..))]
    pub memory: u32,
}

/// Summarise a model, or write out every compiled array
#[derive(Args)]
#[command(
    after_help = "In JSON, numbers that are not finite are the strings \"Infinity\", \"-Infinity\" and \"NaN\".

Examples:
  robohive inspect assets/elbow/elbow.xml                   sizes, options, bodies
  robohive inspect assets/elbow/elbow.xml --npz elbow.npz   every array under its MuJoCo name
  robohive inspect assets/elbow/elbow.xml --json | jq .sizes
  robohive inspect - < assets/pile/pile.xml"
)]
pub struct Inspect {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Write every model array to this numpy archive
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub npz: Option<PathBuf>,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

/// Compile a model into one file that loads in milliseconds
#[derive(Args)]
#[command(
    after_help = "The file holds all arrays, meshes and textures included, bit for bit; every command takes it \
as MODEL. A version of robohive with other arrays refuses it: compile the text again.

Examples:
  robohive compile assets/franka/franka_table.xml --out franka.rhm
  robohive sim franka.rhm --seconds 2"
)]
pub struct Compile {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// File to write
    #[arg(long, value_name = "FILE.rhm", value_hint = ValueHint::FilePath)]
    pub out: PathBuf,
}

/// Simulate a model under the controls of a keyframe, or none
#[derive(Args)]
#[command(
    after_help = "A row of the trajectory holds a state, the controls in force from then on, and the sensor \
readings and energy; the first is the initial state. It is written while the model moves, in bounded \
memory, to FILE.part/NAME.npy, of which FILE is made at the end. Ctrl-C and instability end a run early: FILE then holds \
all rows so far, the last one, if its step failed, with sensor readings and energy NaN. Of a process that is killed \
remains FILE.part, whose arrays numpy can load.

A video has at most 50 frames for each simulated second unless --fps says otherwise; it, too, is complete after Ctrl-C.

Examples:
  robohive sim assets/pile/pile.xml --seconds 2
  robohive sim assets/franka/franka_table.xml --keyframe ready --out run.npz
  robohive sim assets/pile/pile.xml --seconds 1 --video pile.gif --size 160x120 --fps 20
  python -c \"import numpy; print(numpy.load('run.npz')['qpos'].shape)\""
)]
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
    /// Write time, qpos, qvel, act, ctrl, sensordata and energy of the initial state and of every step
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
    /// No progress on standard error
    #[arg(long, short)]
    pub quiet: bool,
    /// Its video
    #[command(flatten)]
    pub film: FilmArguments,
}

/// Step or forward recorded inputs and write the named fields
#[derive(Args)]
#[command(
    after_help = "IN holds any of qpos, qvel, act, ctrl, mocap_pos, mocap_quat, qfrc_applied, xfrc_applied, \
eq_active, qacc_warmstart, time, one row a step or state, or an array of the shape of the field itself as the only row; what it leaves out takes the value of a plain reset. \
What `sim --out` writes is such a file; its sensordata and energy are not read.

By default the rollout starts from row 0 and takes one row of ctrl a step; the fields are written after every step. \
With --forward every row is an independent state and the fields of its forward pass are written; fields whose \
length varies are concatenated in row order, and ncon and nefc tell the split. Contacts are contact.dist, \
contact.pos, ...

Examples:
  robohive sim assets/pile/pile.xml --out motion.npz
  robohive trace assets/pile/pile.xml --in motion.npz --out again.npz --fields qpos,sensordata
  robohive trace assets/pile/pile.xml --in motion.npz --out forces.npz --forward \\
    --fields qacc,efc_J,contact.dist"
)]
pub struct Trace {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Numpy archive with inputs
    #[arg(long = "in", value_name = "IN.npz", value_hint = ValueHint::FilePath)]
    pub input: PathBuf,
    /// Numpy archive to write
    #[arg(long, value_name = "OUT.npz", value_hint = ValueHint::FilePath)]
    pub out: PathBuf,
    /// Fields to write, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "time,qpos,qvel,act")]
    pub fields: Vec<String>,
    /// Treat every row as an independent state
    #[arg(long)]
    pub forward: bool,
    /// Reset a state that is not finite or too large, as MuJoCo does, instead of ending there
    #[arg(long, conflicts_with = "forward")]
    pub autoreset: bool,
}

/// Compare a model with what MuJoCo recorded of it
#[derive(Args)]
#[command(
    after_help = "Compared are the compiled arrays, the accelerations (qacc) of recorded states, single steps, \
and a rollout of all steps. A rollout follows MuJoCo when it stays within ten times the distance between MuJoCo's run \
and its twin, the same run from a state 1e-12 away: rounding differs in every step and grows as the motion amplifies it.
The last line says whether the model passed; the exit code is 1 when it did not. The reference is written by \
validation/reference/record.py.

Examples:
  robohive check assets/quadruped/quadruped.xml validation/reference/own/quadruped.npz"
)]
pub struct Check {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Recorded reference
    #[arg(value_hint = ValueHint::FilePath)]
    pub reference: PathBuf,
}

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
    /// Measure what standard input asks for, lines "rate N", "stages N" or "jitter N", for one model
    #[arg(long, conflicts_with_all = ["stages", "jitter"])]
    pub requests: bool,
    /// Print one JSON object a model; the last line is the last model's
    #[arg(long)]
    pub json: bool,
}

/// Print completions for a shell
#[derive(Args)]
#[command(after_help = "Put the script where the shell looks for it, and start a new shell.

Examples:
  robohive completions bash > ~/.local/share/bash-completion/completions/robohive
  robohive completions zsh > ~/.zfunc/_robohive
  robohive completions fish > ~/.config/fish/completions/robohive.fish")]
pub struct Completions {
    /// The shell
    pub shell: clap_complete::Shell,
}

/// Print or write manual pages
#[derive(Args)]
#[command(after_help = "Without --out the page of `robohive` itself is printed.

Examples:
  robohive man | man -l -
  robohive man --out share/man/man1")]
pub struct Man {
    /// Write the pages of all commands to this folder
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The example command lines of a help text, as words; what follows a pipe, a redirection or three blanks is no part.
    fn examples(help: &str) -> Vec<Vec<String>> {
        let (_, examples) = help.split_once("Examples:\n").expect("a section of examples");
        let commands = examples.replace("\\\n", " ");
        let command = |line: &str| {
            let end = ["   ", " | ", " > ", " < "].iter().filter_map(|mark| line.find(mark)).min();
            line[..end.unwrap_or(line.len())].split_whitespace().map(str::to_owned).collect()
        };
        commands
            .lines()
            .filter(|line| line.starts_with("  robohive "))
            .map(|line| command(line.trim_start()))
            .collect()
    }

    #[test]
    fn definitions_are_consistent_and_every_example_parses() {
        let mut main = Arguments::command();
        main.clone().debug_assert();
        main.build();
        let own = |command: &clap::Command| command.get_name() != "help";
        let subcommands: Vec<_> = main.get_subcommands().filter(|c| own(c)).collect();
        assert!(subcommands.len() >= 8);
        for command in subcommands {
            let name = command.get_name();
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let examples = examples(&help);
            assert!(examples.iter().any(|words| words[1] == name), "{name} has no example");
            for words in examples {
                if let Err(error) = Arguments::try_parse_from(&words) {
                    panic!("{name}: {words:?}: {error}");
                }
            }
        }
    }
}
