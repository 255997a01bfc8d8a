//! How runs start: from arguments to a configuration, its environment, and a run in a folder.

use super::teacher::TeacherArguments;
use crate::failure::Failure;
use crate::input::library::Making;
use crate::input::policy::failure;
use crate::input::solver::SolverArgument;
use agents::learn::{Algorithm, Demonstrations, Settings};
use agents::run::{Config, Run};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use env::{Compat, Env};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::Path;

/// What is trained, and how.
#[derive(Args)]
pub struct Starting {
    /// How environments are made
    #[command(flatten)]
    pub making: Making,
    /// How it is learnt [default: npg, or what CONFIG says]
    #[arg(long, value_name = "NAME", value_parser = algorithms())]
    algo: Option<String>,
    /// Who shows how it is done
    #[command(flatten)]
    teacher: TeacherArguments,
    /// Iterations from one checkpoint to the next [default: 10, or what CONFIG says]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    keep_every: Option<u64>,
}

impl Starting {
    /// The configuration of an id, or that in a file, with what is given beside it.
    ///
    /// # Errors
    /// The file cannot be read, or is no configuration; demonstrations of nobody.
    pub fn config(&self, what: &str) -> Result<Config, Failure> {
        let mut config = if what.ends_with(".toml") {
            Config::read(Path::new(what)).map_err(failure)?
        } else {
            Config {
                compat: Some(self.making.compat.to_string()),
                solver: Some(self.making.solver.name()),
                environment: self.making.changes()?,
                ..Config::new(what, Settings::npg())
            }
        };
        if let Some(settings) = self.algo.as_deref().and_then(Settings::named) {
            config.learning = settings;
        }
        config.teacher = self.teacher.given(config.teacher)?;
        config.keep_every = self.keep_every.unwrap_or(config.keep_every);
        Ok(config)
    }

    /// Refuses what is given beside a configuration and differs from it, which says how its environment is made.
    ///
    /// # Errors
    /// An option differs.
    pub fn check(&self, config: &Config) -> Result<(), Failure> {
        let making = made(self.making.clone(), config)?;
        let (given, none) = (self.making.changes()?, env::Arguments::default());
        for (option, differs) in [
            ("--set", given != none && given != config.environment),
            ("--compat", ![Compat::Fixed, making.compat].contains(&self.making.compat)),
            ("--solver", !self.making.solver.is_own() && making.solver.is_own()),
        ] {
            if differs {
                let message =
                    format!("{option} belongs to a run from its beginning: change it in a copy of run.toml");
                return Err(Failure::usage(message));
            }
        }
        Ok(())
    }
}

/// Algorithms by name.
fn algorithms() -> PossibleValuesParser {
    PossibleValuesParser::new(Algorithm::NAMES.map(|(name, what)| PossibleValue::new(name).help(what)))
}

/// How a configuration says that its environment is made.
fn made(mut making: Making, config: &Config) -> Result<Making, Failure> {
    if let Some(compat) = &config.compat {
        making.compat = compat.parse().map_err(Failure::usage)?;
    }
    if let Some(solver) = &config.solver {
        making.solver = SolverArgument::named(solver)?;
    }
    Ok(making)
}

/// The environment of a configuration.
///
/// # Errors
/// There is none of its id, or it cannot be made.
pub fn environment(making: Making, config: &Config) -> Result<Env, Failure> {
    let making = made(making, config)?;
    let library = making.assets()?;
    let options = making.options()?.with_changes(config.environment.clone());
    Env::make(&config.id, &library, &options).map_err(Failure::usage)
}

/// Begins the run of a configuration in a new or empty folder, with this number of threads.
///
/// # Errors
/// A teacher fails; the folder holds something or cannot be written.
pub fn begin(folder: &Path, config: Config, env: &Env, threads: usize, quiet: bool) -> Result<Run, Failure> {
    let asked = config.teacher.as_ref().filter(|_| !quiet).map_or(0, |teaching| teaching.lessons.episodes);
    let bar = if asked == 0 { ProgressBar::hidden() } else { ProgressBar::new(asked) };
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} demonstrations, {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let tell = |kept: &Demonstrations| bar.set_position(kept.sizes()[0] as u64);
    let run = Run::create(folder, config, env, threads, tell);
    bar.finish_and_clear();
    run.map_err(failure)
}
