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
//! What most programs need stands here; all else is in [`physics`], whose [`elements`](physics::elements) explain names
//! and views, in [`mjcf`] and, with the feature of that name, in `dataset`.

#[cfg(feature = "dataset")]
pub use dataset;
pub use mjcf;
pub use physics;

pub use mjcf::{Loaded, Loader, load, load_str};
pub use physics::ray::{Ray, RayFilter};
pub use physics::{Batch, BatchError, Data, Environment, Model, Snapshot, StepError, forward, inverse, step};

/// The program of README.md runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
