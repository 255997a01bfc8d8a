//! `view`: a model in a window.

use crate::failure::Failure;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Look at a model in a window, run it, pull it
#[derive(Args)]
#[command(
    after_help = "Space runs and pauses, the arrows step forward and back, a double click selects a body, Ctrl with the right \
button pulls it, and F1 shows all keys and gestures, which are those of MuJoCo's viewer. A model is read again when its file is \
saved, and goes on in the state that it is in. Without MODEL the window is empty: drop a file on it, or choose a model of our own.

A build has the window with the feature `window`: cargo install --path src/cli --features window

Examples:
  robohive view assets/franka/franka_table.xml
  robohive view quadruped                         a model of our own
  robohive view"
)]
pub struct View {
    /// MJCF, URDF, a model written by `compile`, or the name of a model of our own
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub model: Option<PathBuf>,
}

/// Runs the command.
#[cfg(feature = "window")]
pub fn run(a: &View) -> Result<(), Failure> {
    use viewer::window::{Source, run};
    let own = |path: &PathBuf| Source::own().find(|source| path.to_str() == Some(&source.title()));
    let source = match &a.model {
        Some(path) if path.is_file() => Some(Source::File(path.clone())),
        Some(path) => Some(own(path).ok_or_else(|| unknown(path))?),
        None => None,
    };
    run(source).map_err(|error| Failure::new(error.to_string()))
}

#[cfg(feature = "window")]
fn unknown(path: &std::path::Path) -> Failure {
    let names: Vec<String> = viewer::window::Source::own().map(|source| source.title()).collect();
    Failure::usage(format!(
        "{} is neither a file nor a model of our own: {}",
        path.display(),
        names.join(", ")
    ))
}

/// Says how to get a window.
#[cfg(not(feature = "window"))]
pub fn run(a: &View) -> Result<(), Failure> {
    let model = a
        .model
        .as_ref()
        .map_or(String::new(), |path| format!("; `robohive render {}` draws a picture", path.display()));
    Err(Failure::usage(format!(
        "this build has no window; `cargo install --path src/cli --features window` installs one that has{model}"
    )))
}
