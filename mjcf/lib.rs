//! MJCF to [`physics::Model`]: text, element tree, typed [`spec::Spec`], compiled arrays.
//!
//! [`load`] does it all; [`Loader`] also edits the text, reads from memory, bounds what a text may cost and keeps
//! compiled models in a [`Cache`]. What is wrong comes back as [`diagnostic::Diagnostics`]: all findings, each with file,
//! line, column, element and, where there is one, the way out.
//!
//! Programs that depend on the crate `robohive` reach this one as `robohive::mjcf`.
//!
//! ```
//! let text = r#"<mujoco>
//!   <worldbody>
//!     <body name="pendulum"><joint name="hinge" axis="0 1 0"/><geom size="0.05" pos="0 0 -0.5"/></body>
//!   </worldbody>
//! </mujoco>"#;
//! let loaded = robohive_mjcf::load_str(text)?;
//! assert_eq!((loaded.model.nq, loaded.model.nbody), (1, 2));
//! assert!(loaded.warnings.is_empty());
//! # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
//! ```
//!
//! [`mesh`] and [`image`] compile single assets; they are public for tools that need no model, and so that decoders can
//! be fuzzed alone.

pub mod asset;
mod budget;
mod cache;
mod compile;
pub mod diagnostic;
mod digest;
pub mod edit;
mod encoding;
mod escape;
pub mod files;
pub mod flex;
pub mod format;
pub mod image;
mod include;
mod loaded;
mod loader;
pub mod mesh;
mod read;
mod schema;
pub mod spec;
mod vector;
mod write;
mod xml;

pub use cache::Cache;
pub use loaded::Loaded;
pub use loader::{Loader, Parsed, load, load_str, parse_str};
pub use schema::print::reference;
pub use xml::Limits;
