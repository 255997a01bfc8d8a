//! Triangles: what every shape of a scene consists of, prepared once per model.
//!
//! ```
//! use robohive_render::{Assets, Profile};
//!
//! let text = "<mujoco><asset><mesh name='corner' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>
//!   <worldbody><geom type='mesh' mesh='corner'/></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let empty = robohive_mjcf::load_str("<mujoco/>")?.model;
//! let [assets, none] = [&model, &empty].map(|model| Assets::new(model, Profile::Mujoco312));
//! assert!(assets?.bytes() > none?.bytes(), "the triangles of a mesh take memory");
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
