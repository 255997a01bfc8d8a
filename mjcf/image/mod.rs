//! Image assets: textures and height fields.
//!
//! ```
//! use robohive_mjcf::image::{Builtin, TextureType, TextureSource, texture};
//!
//! let source = TextureSource {
//!     kind: TextureType::Texture2d,
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
mod ktx;
mod png;
mod scanline;
mod source;
mod texture;

pub use hfield::{CompiledHfield, HfieldSource, hfield};
pub use physics::model::{ColorSpace, TextureType};
pub use source::{Builtin, FileImage, Mark, TextureSource};
pub use texture::{CompiledTexture, texture};
