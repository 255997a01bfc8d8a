//! Recordings of episodes, and the commands that read, convert and replay them.

pub mod data;
pub mod export;
pub mod names;
pub mod open;
pub mod replay;
