//! The `robohive` command: one subcommand a file.

/// Writes a line to standard output.
macro_rules! show {
    ($($text:tt)*) => { $crate::write_line(format_args!($($text)*)) };
}

mod arguments;
mod bench;
mod check;
mod compile;
mod fields;
mod inspect;
mod sim;
mod trace;

use arguments::Reading;
use clap::Parser;
use std::fmt;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

/// Failure of a command: the text for standard error and the exit code.
pub struct Failure {
    message: String,
    code: u8,
}

impl Failure {
    /// The command could not do its work: exit code 1.
    pub fn new(message: impl fmt::Display) -> Self {
        Failure { message: message.to_string(), code: 1 }
    }

    /// The arguments or input files are wrong: exit code 2.
    pub fn usage(message: impl fmt::Display) -> Self {
        Failure { message: message.to_string(), code: 2 }
    }
}

fn main() -> ExitCode {
    let outcome = match arguments::Arguments::parse().command {
        arguments::Command::Inspect(a) => inspect::run(&a),
        arguments::Command::Compile(a) => compile::run(&a),
        arguments::Command::Sim(a) => sim::run(&a),
        arguments::Command::Trace(a) => trace::run(&a),
        arguments::Command::Check(a) => check::run(&a),
        arguments::Command::Bench(a) => bench::run(&a),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("robohive: {}", failure.message);
            ExitCode::from(failure.code)
        }
    }
}

/// Writes a line to standard output. A reader that has seen enough, as `head`, ends the process in silence.
fn write_line(text: fmt::Arguments) {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Ok(()) => {}
        Err(error) if error.kind() == ErrorKind::BrokenPipe => std::process::exit(0),
        Err(error) => {
            eprintln!("robohive: standard output: {error}");
            std::process::exit(1);
        }
    }
}

/// Loads a model and shows its warnings on standard error.
fn load(path: &Path, reading: &Reading) -> Result<physics::Model, Failure> {
    let mut loader = mjcf::Loader::default();
    let named = std::env::var_os("ROBOHIVE_CACHE").filter(|folder| !folder.is_empty());
    if let Some(folder) = reading.cache.clone().or(named.map(Into::into)) {
        loader = loader.cache(mjcf::Cache::new(folder));
    }
    for define in &reading.defines {
        let (text, value) = define
            .split_once('=')
            .filter(|(text, _)| !text.is_empty())
            .ok_or_else(|| Failure::usage(format!("--define {define:?} is not TEXT=VALUE")))?;
        loader = loader.substitute(text, value);
    }
    let loaded = loader.load(path).map_err(Failure::usage)?;
    for warning in loaded.warnings.warnings() {
        eprintln!("{warning}");
    }
    Ok(loaded.model)
}

/// Data of `m` at keyframe `key`; without one, at keyframe 0 when the model has keyframes, else at `qpos0`.
fn start(m: &physics::Model, key: Option<&str>) -> Result<physics::Data, Failure> {
    let mut d = physics::Data::new(m);
    let index = match key {
        None if m.nkey == 0 => return Ok(d),
        None => 0,
        Some(key) => match key.parse() {
            Ok(index) => index,
            Err(_) => m
                .id_of(physics::model::ObjType::Key, key)
                .ok_or_else(|| Failure::usage(format!("the model has no keyframe {key:?}")))?,
        },
    };
    d.reset_to_key(m, index).map_err(Failure::usage)?;
    Ok(d)
}

/// A file that cannot be written.
fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    move |error| Failure::new(format!("{}: {error}", path.display()))
}
