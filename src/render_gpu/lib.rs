//! Pictures of many simulations at once, drawn by a GPU: the same scenes from the same assets as the CPU renderer of
//! [`render`], whose picture is the reference.
//!
//! # Dataflow
//! A batch of scenes becomes a list of instances and calls (`stage`), which is uploaded at once. Surfaces and textures are
//! uploaded when they are first seen, or change. The commands (`encode`) draw all pictures side by side into one atlas,
//! which is read back once. A picture may also stay in the memory of the GPU ([`GpuRenderer::show`]), for a window that is
//! drawn by the same GPU; in a page, where nothing may wait, that is all there is.
//!
//! ```
//! # use render as robohive_render;
//! use robohive_render::{Settings, painter::Painter};
//! use robohive_render_gpu::{Choice, EitherRenderer, GpuError, GpuRenderer};
//!
//! let choice = Choice::Named("no such card".into());
//! let missing = GpuRenderer::new(Settings::default(), &choice).err();
//! assert!(matches!(missing, Some(GpuError::NoAdapter { .. })), "{missing:?}");
//! // Draws on the CPU instead, and a line on the standard error stream says so.
//! let renderer = EitherRenderer::new(Settings::default(), &choice);
//! assert!(renderer.name() == "CPU" && !renderer.draws_batches());
//! ```
//!
//! # Conventions
//! - On the GPU the world is relative to the eye of each picture, so that single precision suffices.
//! - Row 0 of a target is the lowest of a picture: the patterns of samples of Vulkan, Metal and Direct3D, upside down, are
//!   OpenGL's. Rows are exchanged when they are read back.
//! - Depth of pictures is reversed: 1 at the near plane. Depth in shadow maps is not: 0 at the near plane.

mod adapter;
mod atlas;
mod device;
#[cfg(not(target_arch = "wasm32"))]
mod either;
mod encode;
mod error;
mod growing;
mod lamps;
mod list;
mod meshes;
mod passes;
mod pipelines;
mod places;
mod renderer;
mod stage;
mod textures;

#[cfg(not(target_arch = "wasm32"))]
pub use adapter::adapters;
pub use adapter::{Adapter, Choice};
#[cfg(not(target_arch = "wasm32"))]
pub use either::{EitherPainters, EitherRenderer};
pub use error::GpuError;
pub use renderer::{GpuRenderer, Shown};
/// Its types are those of [`GpuRenderer::shared`].
pub use wgpu;
