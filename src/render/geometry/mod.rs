//! Triangles: what every shape of a scene consists of, prepared once per model.
//!
//! ```
//! use robohive_render::{Assets, Profile};
//!
//! let text = "<mujoco><worldbody><geom name='box' type='box' size='1 1 1'/></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let empty = robohive_mjcf::load_str("<mujoco/>")?.model;
//! let [assets, none] = [&model, &empty].map(|model| Assets::new(model, Profile::Mujoco312));
//! assert!(assets?.bytes() > none?.bytes(), "the triangles of a box take memory");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
