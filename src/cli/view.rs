//! `view`: a model or an environment in a window.

use crate::failure::Failure;
use crate::input::library::Making;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Look at a model or an environment in a window, run it, pull it
#[derive(Args)]
#[command(
    after_help = "Space runs and pauses, the arrows step forward and back, a double click selects a body, Ctrl with the right \
button pulls it, and F1 shows all keys and gestures, which are those of MuJoCo's viewer. A model is read again when its file is \
saved, and goes on in the state that it is in. Without a name the window is empty: drop a file on it, or choose a model or an \
environment of our own.

An environment plays episode after episode, seeded with SEED, SEED + 1 and so on, as `robohive run` does; the window shows rewards, \
observations and success, and what acts can be changed to zero actions, random ones, the policy, or sliders that you move.

A build has the window with the feature `window`: cargo install --path src/cli --features window

Examples:
  robohive view assets/franka/franka_table.xml
  robohive view quadruped
  robohive view hive/FrankaReach-v0
  robohive view door-v1 --policy door-v1.pickle
  robohive view"
)]
pub struct View {
    /// A file (MJCF, URDF, or what `compile` wrote), the name of a model of our own, or the id of an environment
    #[arg(value_name = "MODEL|ID", value_hint = ValueHint::FilePath)]
    pub subject: Option<PathBuf>,
    /// A policy that acts in the environment
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub policy: Option<PathBuf>,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
    /// How the environment is made
    #[command(flatten)]
    pub making: Making,
}

/// Runs the command.
#[cfg(feature = "window")]
pub fn run(a: &View) -> Result<(), Failure> {
    let source = a.subject.as_deref().map(|subject| subjects::find(a, subject)).transpose()?;
    viewer::window::run(source).map_err(|error| Failure::new(error.to_string()))
}

/// Says how to get a window.
#[cfg(not(feature = "window"))]
pub fn run(a: &View) -> Result<(), Failure> {
    let instead = a
        .subject
        .as_ref()
        .map_or(String::new(), |path| format!("; `robohive render {}` draws a picture", path.display()));
    Err(Failure::usage(format!(
        "this build has no window; `cargo install --path src/cli --features window` installs one that has{instead}"
    )))
}

/// From a name to what the window shows.
#[cfg(feature = "window")]
mod subjects {
    use super::View;
    use crate::failure::Failure;
    use agents::Policy;
    use env::{Env, Registry};
    use std::path::Path;
    use viewer::Play;
    use viewer::window::{Recipe, Source};

    /// A file, an environment, or a model of our own.
    pub fn find(a: &View, subject: &Path) -> Result<Source, Failure> {
        if subject.is_file() {
            return Ok(Source::File(subject.to_owned()));
        }
        let name = subject.to_string_lossy();
        if Registry::builtin().spec(&name).is_ok() {
            return environment(a, &name);
        }
        Source::own().find(|source| source.title() == name).ok_or_else(|| unknown(&name))
    }

    fn environment(a: &View, id: &str) -> Result<Source, Failure> {
        let policy = a
            .policy
            .as_ref()
            .map(Policy::open)
            .transpose()
            .map_err(|error| Failure::usage(error.to_string()))?;
        let (library, options, seed) = (a.making.assets()?, a.making.options()?, a.seed);
        let name = id.to_owned();
        let make = move || {
            let env = Env::make(&name, &library, &options)?;
            Ok(Play::new(env, policy.clone(), seed)?.made_by(options.clone()))
        };
        // What is wrong is said here rather than in the window.
        make().map_err(Failure::usage)?;
        Ok(Source::Environment(Recipe::new(id, make)))
    }

    fn unknown(name: &str) -> Failure {
        let near = Registry::builtin().spec(name).err().map(|error| error.to_string()).unwrap_or_default();
        let names: Vec<String> = Source::own().map(|source| source.title()).collect();
        Failure::usage(format!(
            "{name} is neither a file nor a model of our own ({}) nor an environment: {near}",
            names.join(", ")
        ))
    }
}
