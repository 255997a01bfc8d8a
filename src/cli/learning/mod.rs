//! Commands that train policies and say how good they are.

pub mod evaluate;
mod playing;
pub mod report;
mod teacher;
pub mod train;
