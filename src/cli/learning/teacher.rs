//! Who shows a training how its task is done.

use crate::failure::Failure;
use agents::learn::{Lessons, Teaching};
use clap::Args;

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
