//! Image assets: textures and height fields.

mod builtin;
mod hfield;
mod png;
mod texture;

pub use builtin::{Builtin, Mark};
pub use hfield::{CompiledHfield, HfieldSource, hfield};
pub use texture::{Colorspace, CompiledTexture, FileImage, TextureKind, TextureSource, texture};
