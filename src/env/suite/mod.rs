//! The tasks, one a file, by the suites of RoboHive, ROBEL's claw, and Gymnasium's locomotion.
//!
//! A row of the registry names a task, and gives the settings that the task asks for:
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let shorter = Options { changes: "pose_thd = 10.0".parse()?, ..Options::default() };
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &shorter)?;
//! env.reset(Some(1))?;
//! env.step(&vec![0.0; env.action_len()])?;
//! assert!(env.verdict().solved, "every pose is within 10 rad of the wanted one");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod arms;
mod baoding;
mod bonus;
mod circling;
pub mod claws;
pub mod dclaw;
mod fatigue;
pub mod fm;
pub mod gymnasium;
pub mod hands;
pub mod multitask;
pub mod muscle;
pub mod myobase;
pub mod myochallenge;
pub mod myodm;
mod named;
pub mod quadrupeds;
pub mod quirks;
mod ranges;

pub use bonus::bonus;
pub use ranges::Ranges;

use crate::assets::Assets;
use crate::error::EnvError;
use crate::spec::Spec;
use crate::task::{Setup, Task};
use toml::Table;

/// Builds a task: from the id with all its settings, those that are the task's own, files, and the world.
pub type Build = fn(&Spec, Table, &dyn Assets, &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError>;

/// A task: the name that rows of the registry use, and what builds it.
pub type Entry = (&'static str, Build);

/// The tasks of every suite.
const SUITES: [&[Entry]; 11] = [
    arms::TASKS,
    claws::TASKS,
    dclaw::TASKS,
    fm::TASKS,
    gymnasium::TASKS,
    hands::TASKS,
    multitask::TASKS,
    myobase::TASKS,
    myochallenge::TASKS,
    myodm::TASKS,
    quadrupeds::TASKS,
];

/// Builds the task of an id.
///
/// # Errors
/// The task is unknown, or its settings or the model do not fit.
pub fn build(
    spec: &Spec,
    own: Table,
    assets: &dyn Assets,
    setup: &mut Setup<'_>,
) -> Result<Box<dyn Task>, EnvError> {
    let tasks = || SUITES.iter().copied().flatten();
    match tasks().find(|(name, _)| *name == spec.task) {
        Some((_, build)) => build(spec, own, assets, setup),
        None => {
            let names: Vec<_> = tasks().map(|(name, _)| *name).collect();
            Err(spec.wrong(format!("there is no task {}; there are {}", spec.task, names.join(", "))))
        }
    }
}
