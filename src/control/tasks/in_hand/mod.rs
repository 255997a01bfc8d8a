//! Hands that move things: plans by sampling, a cost for each task.

pub mod pen;
pub mod reorient;
mod search;
