//! RoboHive.

pub mod asset;
pub mod bvh;
pub mod compile;
pub mod diagnostic;
pub mod files;
pub mod image;
pub mod include;
pub mod loader;
pub mod mesh;
pub mod principal;
pub mod read;
pub mod schema;
pub mod spec;
pub(crate) mod vector;
pub mod xml;
