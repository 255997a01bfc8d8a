//! The CPU renderer: from a scene to a picture.
//!
//! What is seen is decided first, sample by sample (`visibility`), then each visible triangle's corners are lit, and each
//! fragment is shaded once. The result equals what MuJoCo's many passes over all triangles add up to.
//!
//! ```
//! use robohive_render::Settings;
//! use robohive_render::raster::Samples;
//!
//! let text = "<mujoco><visual><quality offsamples='0'/></visual></mujoco>";
//! let settings = Settings::of(&robohive_mjcf::load_str(text)?.model);
//! assert_eq!(settings.samples, Samples::One);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod backdrop;
mod batch;
mod colour;
mod draws;
mod image;
mod labels;
mod layer;
mod lines;
mod mirror;
mod opaque;
mod renderer;
mod settings;
mod shadow;
mod stage;
mod still;
mod umbra;
mod visibility;
mod window;

pub use batch::Batch;
pub use colour::transparency::distance as distance_of_nearest_point;
pub use draws::{Draw, Draws};
pub use labels::{draw as draw_labels, letter_rows};
pub use lines::Line;
pub use mirror::plane_of as mirror_plane;
pub use renderer::{Renderer, Shot};
pub use settings::{Samples, Settings};
pub use shadow::{CasterRule, Maps as ShadowMaps, ShadowSettings, maps as shadow_maps};
pub use window::coverage::Facing;
pub use window::projection::{Affine, Projection, mirror as mirror_map};
