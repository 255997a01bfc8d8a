//! Domain randomisation: what differs from episode to episode in the look of a scene (`visual_randomization`) and in its
//! physics (`physics_randomization`).
//!
//! A configuration names elements of the model and ranges; all that it names is drawn at every reset. Draws come from streams of
//! their own, so that a task draws the same with and without them; they are written into this environment's copy of the model, and
//! kept to be recorded and restored ([`Env::look`](crate::Env::look), [`Env::mechanics`](crate::Env::mechanics)).
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let changes = "[physics_randomization]\ngravity = { low = [0, 0, -12], high = [0, 0, -11] }".parse()?;
//! let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default().with_changes(changes))?;
//! env.reset(Some(1))?;
//! let drawn = env.mechanics().unwrap()["option/gravity"][2];
//! assert!((-12.0..-11.0).contains(&drawn) && env.scene().model.opt.gravity[2] == drawn);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod choice;
mod dial;
mod drawn;
mod mechanics;
mod randomized;
mod visual;

pub use mechanics::{
    ActuatorRange, FrictionRange, JointRange, Keeps, LayoutRange, MassRange, PhysicsRandomization,
    SensorRange, SizeRange,
};
pub use visual::{
    CameraRange, DistractorRange, LightRange, MaterialRange, Pattern, TextureRange, VisualRandomization,
};

pub(crate) use randomized::{Randomized, RandomizedState};
