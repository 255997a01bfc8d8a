//! MJCF to [`physics::Model`]: text, element tree, typed `Spec`, compiled arrays.
//!
//! [`load`] does it all; [`Loader`] also edits the tree, reads from memory and bounds what a text may cost.

pub mod asset;
pub mod bvh;
pub mod cache;
pub mod compile;
pub mod diagnostic;
pub mod files;
pub mod image;
pub mod include;
pub mod loader;
pub mod mesh;
pub mod read;
pub mod schema;
pub mod spec;
mod suggestion;
pub(crate) mod vector;
pub mod xml;

pub use cache::Cache;
pub use loader::{Loaded, Loader, Parsed, load, load_str, parse_str};
