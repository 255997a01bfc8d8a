//! Commands that train policies and say how good they are.

pub mod evaluate;
pub mod train;
