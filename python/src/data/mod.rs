//! Recordings of episodes and datasets made of them, for Python. Arrays cross as dtype, shape and bytes.

mod array;
mod failure;
mod lerobot;
mod minari;
mod trace;

pub use lerobot::{LeRobotFrames, LeRobotWriter, export_lerobot};
pub use minari::{MinariWriter, env_spec, export_minari};
pub use trace::{Trace, TraceWriter, convert_trace, repair_trace};
