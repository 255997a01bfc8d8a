//! The CPU renderer: from a scene to a picture.
//!
//! What is seen is decided first, sample by sample (`visibility`), then each visible triangle's corners are lit, and each
//! fragment is shaded once. The result equals what MuJoCo's many passes over all triangles add up to.

mod backdrop;
mod batch;
mod clip;
mod coverage;
mod draws;
mod image;
mod labels;
mod layer;
mod lighting;
mod lines;
mod mirror;
mod opaque;
mod paint;
mod power;
mod renderer;
mod seen;
mod settings;
mod shadow;
mod sky;
mod stage;
mod still;
mod texels;
mod transparency;
mod umbra;
mod vertices;
mod visibility;
mod window;

pub use batch::Batch;
pub use coverage::Facing;
pub use draws::{Draw, Draws};
pub use labels::{draw as draw_labels, letter_rows};
pub use lines::Line;
pub use mirror::plane_of as mirror_plane;
pub use renderer::{Renderer, Shot};
pub use settings::{Samples, Settings};
pub use shadow::{CasterRule, Maps as ShadowMaps, ShadowSettings, maps as shadow_maps};
pub use transparency::distance as distance_of_nearest_point;
pub use window::{Affine, Projection, mirror as mirror_map};
