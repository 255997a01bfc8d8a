//! Pictures of a simulation without OpenGL: what MuJoCo 3.12's offscreen renderer draws, on the CPU, with the same bits on
//! every machine.
//!
//! # Dataflow
//! A [`Model`](physics::Model) is prepared once as [`Assets`]: triangles and textures, shared by every picture. For each
//! state a [`Scene`] lists what is to be drawn from one camera. A renderer turns both into a [`Picture`].
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_physics::{Data, forward};
//! use robohive_render::picture::Channels;
//! use robohive_render::scene::{Camera, SceneOptions};
//! use robohive_render::{Assets, Picture, Profile, Renderer, Scene, Settings};
//!
//! let text = "<mujoco><worldbody><geom type='plane' size='2 2 .1'/><geom size='.5' pos='0 0 .5'/></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let assets = Assets::new(&model, Profile::Mujoco312)?;
//! let view = Camera::named(&model, "free")?.view(&model, &data)?;
//! let mut scene = Scene::new();
//! scene.update(&model, &data, view, &SceneOptions::default())?;
//! let mut picture = Picture::new(64, 48);
//! Renderer::new(Settings::of(&model)).draw(&assets, &scene, Channels::ALL, &mut picture)?;
//! // The ball, geom 1, is in the middle.
//! assert_eq!(picture.segmentation[24 * 64 + 32][0], 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//! - World z up, metres. A camera looks along its own -z with +y up.
//! - Pictures have row 0 at the top. Inside the rasteriser row 0 is at the bottom, as in OpenGL, since the pattern of
//!   samples and the groups of 2 by 2 pixels that texture filters need are fixed there.
//! - Depth inside is reversed: 1 at the near plane, 0 at the far one. Depth of a [`Picture`] is in metres.
//! - Arithmetic has a fixed order, `f32` for triangles and colours, `f64` for projections and the sky; transcendental functions come from `robohive_physics::math::ops` or from
//!   polynomials of this crate.
//! - Vectors of numbers are only added, subtracted, multiplied, divided, compared, selected and rooted: IEEE 754 defines each
//!   of these results. Fused products and conversions of vectors to integers differ between processors and are not used.
//!   Minima and maxima are used only where neither NaN nor the sign of zero matters. No sign or payload of a NaN reaches a
//!   picture. So every 64-bit processor whose vectors keep denormal numbers and round to nearest, such as aarch64, draws the
//!   same bits. The checks of builds compare x86-64 with and without AVX2, and WebAssembly with and without vectors.

pub mod error;
pub mod geometry;
pub mod painter;
pub mod picture;
pub mod profile;
pub mod raster;
pub mod scene;
// The filters of textures, which other renderers of this workspace prepare their own from.
#[doc(hidden)]
pub mod texture;
pub mod view;

pub use error::RenderError;
pub use geometry::Assets;
pub use painter::{Painter, Painters};
pub use picture::Picture;
pub use profile::Profile;
pub use raster::{Renderer, Settings};
pub use scene::Scene;
pub use view::View;
