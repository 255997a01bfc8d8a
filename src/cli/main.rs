//! The `robohive` command: one subcommand a file.

mod arguments;
mod assets;
mod bench;
mod bench_env;
mod bench_render;
mod bench_visual;
mod check;
mod check_env;
mod compile;
mod completions;
mod convert;
mod data;
mod drawing;
mod env_requests;
mod export;
mod fields;
mod film;
mod gallery;
mod info;
mod inspect;
mod interrupt;
mod library;
mod list;
mod loading;
mod look;
mod man;
mod memory;
mod preview;
mod recorded;
mod recording;
mod render;
mod render_requests;
mod renderer;
mod replay;
mod rollout;
mod run;
mod sim;
mod subject;
mod terminal;
mod trace;

use arguments::{Arguments, Command};
use clap::Parser;
use std::fmt;
use std::path::Path;
use std::process::ExitCode;

/// Why a command did not succeed: the text for standard error, unless all is said, and the exit code.
pub struct Failure {
    message: Option<String>,
    code: u8,
}

impl Failure {
    /// The command could not do its work: exit code 1.
    pub fn new(message: impl fmt::Display) -> Self {
        Failure { message: Some(message.to_string()), code: 1 }
    }

    /// The arguments or input files are wrong: exit code 2.
    pub fn usage(message: impl fmt::Display) -> Self {
        Failure { message: Some(message.to_string()), code: 2 }
    }

    /// The output has said why.
    pub fn silent(code: u8) -> Self {
        Failure { message: None, code }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message.as_deref().unwrap_or_default())
    }
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::List(a) => list::run(&a),
        Command::Info(a) => info::run(&a),
        Command::Run(a) => run::run(&a),
        Command::Render(a) => render::run(&a),
        Command::Gallery(a) => gallery::run(&a),
        Command::Rollout(a) => rollout::run(&a),
        Command::BenchEnv(a) => bench_env::run(&a),
        Command::BenchRender(a) => bench_render::run(&a),
        Command::CheckEnv(a) => check_env::run(&a),
        Command::Inspect(a) => inspect::run(&a),
        Command::Compile(a) => compile::run(&a),
        Command::Convert(a) => convert::run(&a),
        Command::Sim(a) => sim::run(&a),
        Command::Trace(a) => trace::run(&a),
        Command::Check(a) => check::run(&a),
        Command::Bench(a) => bench::run(&a),
        Command::Assets(a) => assets::run(&a),
        Command::Data(a) => data::run(&a),
        Command::Completions(a) => completions::run(&a),
        Command::Man(a) => man::run(&a),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.message.iter().for_each(|message| terminal::complain(message));
            ExitCode::from(failure.code)
        }
    }
}

/// A file that cannot be written.
fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    move |error| Failure::new(format!("{}: {error}", path.display()))
}
