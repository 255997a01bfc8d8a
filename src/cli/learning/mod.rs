//! Commands that train policies and say how good they are.

mod comparing;
pub mod evaluate;
mod playing;
pub mod report;
mod starting;
pub mod sweep;
mod teacher;
pub mod train;
mod varying;
