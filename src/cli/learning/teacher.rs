//! Who shows a training how its task is done.

use crate::failure::Failure;
use crate::input::actor::{fault, teacher};
use crate::input::policy::failure;
use agents::learn::{Demonstrations, Lessons};
use agents::run::{Config, Run, Teaching};
use clap::Args;
use env::Env;
use indicatif::{ProgressBar, ProgressStyle};

/// Demonstrations where nothing is said, and the deviation of what disturbs them.
const DEFAULT: Lessons = Lessons { episodes: 50, noise: 0.05 };

/// Options of demonstrations.
#[derive(Args)]
pub struct TeacherArguments {
    /// Who shows how it is done, for bc, dagger and dapg: a controller's name, or the file of a policy
    #[arg(long, value_name = "NAME|FILE")]
    teacher: Option<String>,
    /// Episodes in which the teacher succeeds [default: 50, or what CONFIG says]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    demonstrations: Option<u64>,
    /// Deviation of what is added to the teacher's actions when they are taken, so that it shows how to get back on its way
    /// [default: 0.05, or what CONFIG says]
    #[arg(long, value_name = "X")]
    demonstration_noise: Option<f64>,
}

impl TeacherArguments {
    /// What is asked for, in place of what a configuration says.
    ///
    /// # Errors
    /// Demonstrations of nobody.
    pub fn given(&self, config: Option<Teaching>) -> Result<Option<Teaching>, Failure> {
        let Some(by) = self.teacher.clone().or(config.as_ref().map(|teaching| teaching.by.clone())) else {
            return match (self.demonstrations, self.demonstration_noise) {
                (None, None) => Ok(None),
                _ => Err(Failure::usage(
                    "--demonstrations and --demonstration-noise are a teacher's: add --teacher NAME|FILE",
                )),
            };
        };
        let Lessons { episodes, noise } = config.map_or(DEFAULT, |teaching| teaching.lessons);
        let lessons = Lessons {
            episodes: self.demonstrations.unwrap_or(episodes),
            noise: self.demonstration_noise.unwrap_or(noise),
        };
        Ok(Some(Teaching { by, lessons }))
    }
}

/// Who teaches a configuration; nobody where nothing is learnt from demonstrations.
///
/// # Errors
/// There is no teacher where one is needed, or one where none is.
pub fn teaching(config: &Config) -> Result<Option<&Teaching>, Failure> {
    match (&config.teacher, config.learning.algorithm.needs_demonstrations()) {
        (None, false) => Ok(None),
        (None, true) => {
            Err(Failure::usage("bc, dagger and dapg learn from a teacher: add --teacher NAME|FILE"))
        }
        (Some(_), false) => Err(Failure::usage(
            "only bc, dagger and dapg learn from a teacher: add --algo bc, dagger or dapg",
        )),
        (Some(teaching), true) => Ok(Some(teaching)),
    }
}

/// The demonstrations of a configuration, played now; none where nothing is learnt from them.
///
/// # Errors
/// [`teaching`] refuses; the teacher fails.
pub fn teach(config: &Config, env: &Env, quiet: bool) -> Result<Option<Demonstrations>, Failure> {
    let Some(Teaching { by, lessons }) = teaching(config)? else { return Ok(None) };
    let mut env = env.fork().map_err(Failure::new)?;
    let mut teacher = teacher(by, &env)?;
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} demonstrations, {eta} left");
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(lessons.episodes) };
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let tell = |kept: &Demonstrations| bar.set_position(kept.sizes()[0] as u64);
    let played = Demonstrations::play(&mut env, &mut teacher, *lessons, config.seed, tell);
    bar.finish_and_clear();
    played.map(Some).map_err(Failure::usage)
}

/// Lets the teacher of a run correct what its policy does, where that is learnt from.
///
/// # Errors
/// The run does not say who its teacher is; it is no teacher for the environment.
pub fn correct(run: &mut Run) -> Result<(), Failure> {
    if !run.config().learning.algorithm.needs_corrections() {
        return Ok(());
    }
    let Some(Teaching { by, .. }) = run.config().teacher.clone() else {
        return Err(Failure::usage(
            "dagger asks a teacher in every iteration, and run.toml names none: add a [teacher]",
        ));
    };
    let made = run.correct(|env| {
        teacher(&by, env).map(|actor| Box::new(actor) as _).map_err(|failure| fault(env, failure))
    });
    made.map_err(failure)
}
