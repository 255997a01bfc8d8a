//! LeRobot's datasets, version 3.0: a folder of
//!
//! - `data/chunk-000/file-000.parquet` …: a row a frame, episodes one after another;
//! - `meta/info.json`, `meta/stats.json`, `meta/tasks.parquet`, `meta/episodes/chunk-000/file-000.parquet` …;
//! - `videos/KEY/chunk-000/file-000.mp4` …: H.264, a file an episode.
//!
//! A frame is a step: `observation.state` before it, `action`, and `next.reward`, `next.done`, `next.success` after it. Numbers
//! are float32, the type that policies take.
//!
//! ```
//! use robohive_exchange::lerobot::FeatureKind;
//!
//! let kind = FeatureKind::of("video").ok_or("no such type")?;
//! assert!(kind.is_picture() && kind.name() == "video");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod export;
mod features;
mod frames;
mod growing;
mod reader;
mod series;
mod stats;
mod table;
mod writer;

pub use export::{Target, export, frames};
pub use features::{Feature, FeatureKind};
pub use frames::{Frames, Pictures};
pub use reader::LeRobotReader;
pub use table::{Cells, Column};
pub use writer::{LeRobotWriter, Settings};
