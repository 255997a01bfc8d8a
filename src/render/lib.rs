//! Pictures of a simulation without OpenGL: what MuJoCo 3.12's offscreen renderer draws, on the CPU, with the same bits on
//! every machine.
//!
//! # Dataflow
//! A [`Model`](physics::Model) is prepared once as [`Assets`]: triangles and textures, shared by every picture. For each
//! state a [`Scene`] lists what is to be drawn from one camera. A renderer turns both into a [`Picture`].
//!
//! # Conventions
//! - World z up, metres. A camera looks along its own -z with +y up.
//! - Pictures have row 0 at the top. Inside the rasteriser row 0 is at the bottom, as in OpenGL, since the pattern of
//!   samples and the groups of 2 by 2 pixels that texture filters need are fixed there.
//! - Depth inside is reversed: 1 at the near plane, 0 at the far one. Depth of a [`Picture`] is in metres.
//! - All arithmetic of a picture is `f32` in a fixed order; transcendental functions come from `physics::math::ops` or from
//!   polynomials of this crate.
//! - Vectors of numbers are only added, subtracted, multiplied, divided, compared, selected and rooted, where IEEE 754 leaves no
//!   choice. Their conversions to integers, minima, maxima and fused products differ between processors and are not used, nor
//!   does the sign or payload of a NaN reach a picture. Other processors of 64 bits, such as aarch64, whose vectors keep
//!   denormal numbers and round to nearest, hence draw the same bits; the table of builds compares x86-64 with and without
//!   AVX2 and WebAssembly with and without vectors.

pub mod error;
pub mod geometry;
pub mod picture;
pub mod profile;
pub mod raster;
pub mod scene;
pub mod texture;
pub mod view;

pub use error::RenderError;
pub use geometry::Assets;
pub use picture::Picture;
pub use profile::Profile;
pub use raster::{Renderer, Settings};
pub use scene::Scene;
pub use view::View;
