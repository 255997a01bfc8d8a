//! RoboHive.

pub mod asset;
pub mod bvh;
pub mod diagnostic;
pub mod image;
pub mod mesh;
pub mod principal;
pub(crate) mod vector;
