//! Recordings of motion and of episodes: written while they happen, read to be replayed.
//!
//! A [`StateRecording`] writes the states of a simulation, row by row, into a numpy archive, and a [`Trajectory`] reads one.
//! Episodes of environments have the layouts of RoboHive and RoboSet:
//! [`Recording`] writes the rows of an episode while it happens, [`Kept`] holds them in memory until it is over; [`Recorded`] reads the actions and states of a trial, and
//! [`Description`] says which environment it is of. The formats themselves are those of `dataset::trace`.

mod description;
mod error;
mod kept;
mod recorded;
mod recording;
mod row;
mod states;
mod trajectory;

pub use description::{COMPAT, Description, ID, SETTINGS};
pub use error::RecordError;
pub use kept::Kept;
pub use recorded::{Column, Recorded};
pub use recording::{EpisodeRecording, Recording};
pub use states::StateRecording;
pub use trajectory::{Trajectory, TrajectoryError};

/// The dataset of a trial that holds the seed of its reset.
pub const SEED: &str = "seed";
/// The datasets of a trial that hold its states.
pub const STATE: &str = "env_infos/state/";
/// The datasets of a trial that hold what was drawn of the look of its scene.
pub const LOOK: &str = "visual_randomization/";
/// The datasets of a trial that hold what was drawn of the physics of its scene.
pub const MECHANICS: &str = "physics_randomization/";
/// The datasets of a trial that hold its images.
const IMAGES: &str = "env_infos/visual_dict/";
