//! RoboHive: robots described in MJCF, moved by physics that follows MuJoCo 3.12.
//!
//! ```
//! use robohive::{Data, load_str, step};
//!
//! let text = "<mujoco><worldbody><body><joint name='hinge' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>";
//! let model = load_str(text)?.model;
//! let hinge = model.joint("hinge").ok_or("no hinge")?;
//! let mut data = Data::new(&model);
//! while data.time() < 0.5 {
//!     step(&model, &mut data)?;
//! }
//! assert!(data.joint(hinge).qpos()[0] > 1.0, "the pendulum falls");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What most programs need stands here; all else is in a module for each part:
//!
//! | module | feature | what it has |
//! |---|---|---|
//! | [`physics`] | | models, states and steps; its [`elements`](physics::elements) explain names and views |
//! | [`mjcf`] | | MJCF and URDF to models; models edited and written |
//! | `env` | `env` | environments with tasks, one by one and many at once |
//! | `control` | `control` | controllers that solve tasks without learning, and their mathematics |
//! | `robot` | `robot` | robots over simulated and real devices |
//! | `render` | `render` | pictures, depth and segmentation |
//! | `video` | `video` | pictures and videos as files |
//! | `dataset` | `dataset` | numpy archives, recordings in HDF5 |
//! | `random` | `random` | numpy's random draws |
//!
//! A module is a crate of its own: `robohive::physics` is the crate `robohive-physics`, whose examples name it
//! `robohive_physics`. The programs in `examples/` name this crate alone.

#[cfg(feature = "control")]
pub use control;
#[cfg(feature = "dataset")]
pub use dataset;
#[cfg(feature = "env")]
pub use env;
pub use mjcf;
pub use physics;
#[cfg(feature = "random")]
pub use random;
#[cfg(feature = "render")]
pub use render;
#[cfg(feature = "robot")]
pub use robot;
#[cfg(feature = "video")]
pub use video;

#[cfg(feature = "env")]
pub use env::{Env, EnvError, OwnModels, VecEnv};
#[cfg(feature = "random")]
pub use random::Generator;
#[cfg(feature = "render")]
pub use render::{Picture, Renderer};
#[cfg(feature = "robot")]
pub use robot::Robot;
#[cfg(feature = "video")]
pub use video::VideoWriter;

pub use mjcf::{Loaded, Loader, load, load_str};
pub use physics::ray::{Ray, RayFilter};
pub use physics::{Batch, BatchError, Data, Environment, Model, Snapshot, StepError, forward, inverse, step};

/// The program of README.md runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
