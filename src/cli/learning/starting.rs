//! How runs start: from arguments to a configuration, its environment, and a run in a folder.

use super::teacher::{TeacherArguments, correct, teach};
use crate::failure::Failure;
use crate::input::library::Making;
use crate::input::policy::failure;
use crate::input::solver::SolverArgument;
use agents::learn::Settings;
use agents::run::{Config, Run};
use clap::{Args, ValueEnum};
use env::{Compat, Env};
use std::path::Path;

/// Environments that each thread steps side by side: networks are faster on several rows.
const SIDE_BY_SIDE: usize = 16;

/// What is trained, and how.
#[derive(Args)]
pub struct Starting {
    /// How environments are made
    #[command(flatten)]
    pub making: Making,
    /// How it is learnt [default: npg, or what CONFIG says]
    #[arg(long, value_name = "NAME")]
    algo: Option<AlgorithmName>,
    /// Who shows how it is done
    #[command(flatten)]
    teacher: TeacherArguments,
    /// Iterations from one checkpoint to the next [default: 10, or what CONFIG says]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    keep_every: Option<u64>,
}

/// Algorithms by name.
#[derive(Clone, Copy, ValueEnum)]
enum AlgorithmName {
    /// The natural policy gradient
    Npg,
    /// Proximal policy optimisation
    Ppo,
    /// Soft actor-critic: learns again and again from all it remembers, where steps are slow
    Sac,
    /// Behaviour cloning: only from demonstrations
    Bc,
    /// Behaviour cloning of a teacher who corrects the policy's own episodes (dataset aggregation)
    Dagger,
    /// The natural policy gradient with demonstrations
    Dapg,
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
                id: what.into(),
                seed: 1,
                iterations: 100,
                keep_every: 10,
                compat: Some(self.making.compat.to_string()),
                solver: Some(self.making.solver.name()),
                environment: self.making.changes()?,
                teacher: None,
                learning: Settings::npg(),
            }
        };
        match self.algo {
            None => {}
            Some(AlgorithmName::Npg) => config.learning = Settings::npg(),
            Some(AlgorithmName::Ppo) => config.learning = Settings::ppo(),
            Some(AlgorithmName::Bc) => config.learning = Settings::cloning(),
            Some(AlgorithmName::Dagger) => config.learning = Settings::dagger(),
            Some(AlgorithmName::Sac) => config.learning = Settings::sac(),
            Some(AlgorithmName::Dapg) => config.learning = Settings::dapg(),
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

/// Begins the run of a configuration in a new or empty folder, on so many threads.
///
/// # Errors
/// A teacher fails; the folder holds something or cannot be written.
pub fn begin(folder: &Path, config: Config, env: &Env, threads: usize, quiet: bool) -> Result<Run, Failure> {
    // Demonstrations come first: a teacher that fails leaves no folder.
    let demonstrations = teach(&config, env, quiet)?;
    let mut run = Run::create(folder, config, env, [SIDE_BY_SIDE, threads]).map_err(failure)?;
    if let Some(demonstrations) = demonstrations {
        run.teach(demonstrations).map_err(failure)?;
    }
    correct(&mut run)?;
    Ok(run)
}

/// Resumes the run in a folder, on so many threads.
///
/// # Errors
/// There is no run, or it is damaged; its teacher is needed and missing.
pub fn resume(folder: &Path, env: &Env, threads: usize) -> Result<Run, Failure> {
    let mut run = Run::resume(folder, env, [SIDE_BY_SIDE, threads]).map_err(failure)?;
    correct(&mut run)?;
    Ok(run)
}
