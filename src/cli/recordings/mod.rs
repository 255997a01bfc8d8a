//! Recordings of episodes, and the commands that read, convert and replay them.

pub mod data;
pub mod export;
pub mod open;
pub mod recorded;
pub mod recording;
pub mod replay;
