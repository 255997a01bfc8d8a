//! What shells and manuals know of the command.

pub mod completions;
pub mod man;
mod markdown;
