//! The `robohive` command: one subcommand a file, in parts that build on those before them: `input` (models and
//! environments by name), `pictures`, `recordings`, `models`, `robots` (devices), `environments`, `learning`; `assets`, `teleop`, `view`,
//! `web` and `shell` beside them.

// Comments of arguments are what `--help` prints, where brackets are units and defaults.
#![allow(rustdoc::broken_intra_doc_links)]

mod arguments;
mod assets;
mod environments;
mod failure;
mod input;
mod interrupt;
mod learning;
mod models;
mod output;
mod pictures;
mod recordings;
mod robots;
mod shell;
mod teleop;
mod terminal;
mod version;
mod view;
mod web;

use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::List(a) => environments::list::run(&a),
        Command::Info(a) => environments::info::run(&a),
        Command::Run(a) => environments::run::run(&a),
        Command::Train(a) => learning::train::run(&a),
        Command::Sweep(a) => learning::sweep::run(&a),
        Command::Evaluate(a) => learning::evaluate::run(&a),
        Command::Report(a) => learning::report::run(&a),
        Command::Render(a) => pictures::render::run(&a),
        Command::Gallery(a) => pictures::gallery::run(&a),
        Command::Teleop(a) => teleop::run(&a),
        Command::Rollout(a) => environments::rollout::run(&a),
        Command::BenchEnv(a) => environments::bench_env::run(&a),
        Command::BenchRender(a) => pictures::bench_render::run(&a),
        Command::CheckEnv(a) => environments::check_env::run(&a),
        Command::Inspect(a) => models::inspect::run(&a),
        Command::Compile(a) => models::compile::run(&a),
        Command::Convert(a) => models::convert::run(&a),
        Command::Sim(a) => models::sim::run(&a),
        Command::Identify(a) => models::identify::run(&a),
        Command::Trace(a) => models::trace::run(&a),
        Command::Check(a) => models::check::run(&a),
        Command::Bench(a) => models::bench::run(&a),
        Command::View(a) => view::run(&a),
        Command::Web(a) => web::run(&a),
        Command::Hardware(a) => robots::hardware::run(&a),
        Command::Wire(a) => robots::wire::run(&a),
        Command::Assets(a) => assets::run(&a),
        Command::Data(a) => recordings::data::run(&a),
        Command::Completions(a) => shell::completions::run(&a, Arguments::command()),
        Command::Man(a) => shell::man::run(&a, Arguments::command()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.message.iter().for_each(|message| terminal::complain(message));
            ExitCode::from(failure.code)
        }
    }
}
