//! From the arguments to an environment.

use crate::failure::Failure;
use crate::input::solver::SolverArgument;
use crate::terminal::note;
use ::library::{Library, Weights};
use clap::{Args, ValueHint};
use env::{Arguments, Compat, Env, EnvError, Hardware, Options};
use mjcf::diagnostic::Diagnostic;
use render::Painters;
use render::painter::Cpu;
use robot::RobotError;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An environment and how it is made.
#[derive(Args)]
pub struct Source {
    /// Id of the environment, as `robohive list` shows them
    #[arg(value_name = "ID")]
    pub id: String,
    /// How it is made
    #[command(flatten)]
    pub making: Making,
}

/// How environments are made.
#[derive(Clone, Args)]
pub struct Making {
    /// Change a setting, e.g. frame_skip=20 or target_xyz_range.low=[0,0,1]; VALUE is TOML, or text
    #[arg(long = "set", value_name = "SETTING=VALUE")]
    pub settings: Vec<String>,
    /// Whose behaviour: `fixed`, or `robohive-0.7` with the original's quirks
    #[arg(long, value_name = "VERSION", default_value_t = Compat::Fixed)]
    pub compat: Compat,
    /// Folder with RoboHive's envs and simhive, instead of the imported assets
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub assets: Option<PathBuf>,
    /// Keep compiled models in this folder [default: the environment variable ROBOHIVE_CACHE, else the user's cache folder]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub cache: Option<PathBuf>,
    /// What moves them
    #[command(flatten)]
    pub solver: SolverArgument,
}

impl Source {
    /// Makes the environment, and shows the warnings of its model on standard error; what imported files are known to have,
    /// `assets verify` says once.
    pub fn make(&self) -> Result<Env, Failure> {
        self.make_with(Arc::new(Cpu))
    }

    /// The same for one whose pictures these painters draw.
    pub fn make_with(&self, painters: Arc<dyn Painters>) -> Result<Env, Failure> {
        self.make_on(None, painters)
    }

    /// The same for one whose robot is hardware.
    pub fn make_on(&self, hardware: Option<Hardware>, painters: Arc<dyn Painters>) -> Result<Env, Failure> {
        let library = self.making.assets()?;
        let options = self.making.options()?.with_painters(painters).with_hardware(hardware);
        let env = Env::make(&self.id, &library, &options).map_err(|error| match error {
            EnvError::Robot(RobotError::Device { .. }) => Failure::new(error),
            error => Failure::usage(error),
        })?;
        let imported = |warning: &&Diagnostic| {
            warning.position.as_ref().is_some_and(|position| library.is_imported(Path::new(&position.path)))
        };
        let own = env.warnings().warnings().filter(|warning| !imported(warning));
        own.for_each(|warning| note(&warning.to_string()));
        Ok(env)
    }
}

impl Making {
    /// Makes an environment.
    pub fn make(&self, id: &str) -> Result<Env, Failure> {
        self.make_with(id, Arc::new(Cpu))
    }

    /// Makes an environment whose pictures these painters draw.
    pub fn make_with(&self, id: &str, painters: Arc<dyn Painters>) -> Result<Env, Failure> {
        self.make_of(id, &self.assets()?, painters)
    }

    fn make_of(&self, id: &str, library: &Library, painters: Arc<dyn Painters>) -> Result<Env, Failure> {
        let options = self.options()?.with_painters(painters);
        Env::make(id, library, &options).map_err(Failure::usage)
    }

    /// How they are made.
    pub fn options(&self) -> Result<Options, Failure> {
        let networks = Arc::new(Weights::from_environment());
        Ok(Options::default()
            .with_compat(self.compat)
            .with_changes(self.changes()?)
            .with_networks(networks)
            .with_engine(self.solver.engine()?))
    }

    /// The settings that differ.
    pub fn changes(&self) -> Result<Arguments, Failure> {
        let mut changes = Arguments::default();
        for setting in &self.settings {
            let (name, value) = setting
                .split_once('=')
                .filter(|(name, _)| !name.is_empty())
                .ok_or_else(|| Failure::usage(format!("--set {setting:?} is not SETTING=VALUE")))?;
            // What is no TOML value is text, so that names need no quotes.
            let parsed = format!("{name} = {value}").parse::<Arguments>();
            let quoted = || Arguments::default().with(name, value);
            let table = parsed
                .or_else(|_| quoted())
                .map_err(|error| Failure::usage(format!("--set {setting:?}: {error}")))?;
            changes.extend(table);
        }
        Ok(changes)
    }

    /// Where files come from.
    pub fn assets(&self) -> Result<Library, Failure> {
        Library::from_environment(self.assets.as_deref(), self.cache.as_deref()).map_err(Failure::new)
    }
}
