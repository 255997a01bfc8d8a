//! Domain randomisation: what differs from episode to episode in the look of a scene (`visual_randomization`) and in its
//! physics (`physics_randomization`).
//!
//! A configuration names elements of the model and ranges; each thing that changes is a dial ([`Dial`](dial::Dial)) with a
//! target, and all dials of a kind are drawn at every reset ([`Drawn`]). Draws come from streams of their own, so that a task draws the same with and without
//! them; they are written into this environment's copy of the model, and kept to be recorded and restored.

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
