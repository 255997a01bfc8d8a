//! Triangles: what every shape of a scene consists of, prepared once per model.

mod assets;
mod builder;
mod flat;
mod flex;
mod hfield;
mod item_parts;
mod mesh;
mod part;
mod round;
mod skin;
mod source;
mod surface;

pub use assets::Assets;
pub use part::{Paint, Part};
pub use surface::{Bounds, CLUSTER, Cluster, Corners, Surface};
