//! Image assets: textures and height fields.
//!
//! ```
//! use robohive_mjcf::image::{Builtin, TextureKind, TextureSource, texture};
//!
//! let source = TextureSource {
//!     kind: TextureKind::Image2d,
//!     builtin: Builtin::Checker,
//!     width: 4,
//!     height: 2,
//!     ..TextureSource::default()
//! };
//! assert_eq!(texture(&source)?.data.len(), 4 * 2 * 3);
//! # Ok::<(), robohive_mjcf::asset::AssetError>(())
//! ```

mod builtin;
mod hfield;
mod png;
mod scanline;
mod source;
mod texture;

pub use hfield::{CompiledHfield, HfieldSource, hfield};
pub use source::{Builtin, Colorspace, FileImage, Mark, TextureKind, TextureSource};
pub use texture::{CompiledTexture, texture};
