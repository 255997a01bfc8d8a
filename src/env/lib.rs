//! RoboHive's environments: a robot in a world with a task, made by id.
//!
//! An id names a [`Spec`] in the [`Registry`]: a task, a model, and settings. [`Env`] runs it by the contract of Gymnasium:
//! `reset` with a seed, `step` with an action; an episode that the task ends is terminated, one that its length or the
//! physics ends is truncated. A task ([`Task`]) is a file in [`suite`]: what is observed, what is rewarded, where episodes
//! start.
//!
//! Programs that depend on the crate `robohive` reach this one as `robohive::env`, with the feature `env`.
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels, Rng};
//!
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default())?;
//! let (mut draws, mut action) = (Rng::pcg64(1_u64), vec![0.0; env.action_len()]);
//! let first = env.reset(Some(7))?.to_vec();
//! for _ in 0..3 {
//!     env.random_action(&mut draws, &mut action)?;
//!     let step = env.step(&action)?;
//!     assert!(step.reward.is_finite() && step.fault.is_none());
//! }
//! // The same seed starts the same episode.
//! assert_eq!(env.reset(Some(7))?, first);
//! # Ok::<(), robohive_env::EnvError>(())
//! ```

mod arguments;
mod assets;
pub mod check;
mod draws;
mod environment;
pub mod episode;
mod error;
mod message;
mod multi_env;
mod peak_force;
mod pictures;
pub mod randomize;
pub mod registry;
pub mod rotation;
mod rows;
mod scene;
mod spec;
pub mod suite;
mod task;
mod task_type;
pub mod team;
pub mod terrain;
mod twins;
mod vector;

pub use crate::arguments::{Arguments, ArgumentsError};
pub use crate::assets::{AssetError, Assets, Folder, OwnModels};
pub use draws::{Ranges, Rng};
#[doc(hidden)]
pub use environment::Injected;
pub use environment::{
    Env, EnvMemory, EnvState, Hardware, OpenCameras, Options, PathReward, Ready, Step, WorldState,
};
pub use error::{EnvError, NotReady, panic_text};
pub use multi_env::MultiEnv;
pub use pictures::cameras::{CameraError, Cameras};
pub use pictures::eyes::{Exteroception, Image, Pixels};
pub use pictures::network::{Network, NetworkError, Networks, NoNetworks};
pub use pictures::rendering::{RenderMode, RenderModeError, Rendering};
pub use pictures::visual;
pub use registry::Registry;
pub use robot::Compat;
pub use rows::{Name, OwnRows, Row, Rows};
pub use scene::Scene;
pub use spec::{RewardMode, Settings, Spec};
pub use task::{Defaults, Episode, Pose, Setup, Success, Task, TaskCopy, Timing, Turn, Verdict, View};
pub use vector::{Autoreset, Final, Real, StepRecord, VecEnv};
