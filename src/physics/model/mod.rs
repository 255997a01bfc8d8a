//! The compiled model: arrays, options, and the enumerations their integers stand for.

pub mod binary;
mod declare;
mod fields;
mod flags;
mod names;
mod options;
mod reader;
mod types;

pub use fields::Model;
pub use flags::{Disable, Enable};
pub use options::*;
pub use types::*;
