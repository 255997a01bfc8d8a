//! Recordings of episodes: RoboHive's `Trace`, a file with one group a trial and one dataset a name.
//!
//! A [`Recorder`] writes them as episodes run, a [`TraceReader`] reads those that it, RoboHive or h5py wrote.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use robohive_dataset::trace::{Layout, Precision, Recorder, TraceReader};
//!
//! let path = std::env::temp_dir().join(format!("robohive-trace-{}.h5", std::process::id()));
//! let mut recorder = Recorder::create(&path, Layout::RoboHive, Precision::Full)?;
//! let mut trial = recorder.begin("Trial0")?;
//! for step in 0..3 {
//!     trial.push("time", &[], &[0.04 * f64::from(step)])?;
//!     trial.push("actions", &[2], if step < 2 { &[0.5, -0.5] } else { &[f64::NAN; 2] })?;
//!     trial.push("env_infos/solved", &[], &[step == 2])?;
//! }
//! trial.finish()?;
//! recorder.close()?;
//!
//! let trace = TraceReader::open(&path)?;
//! let solved = trace.entry("Trial0", "env_infos/solved")?;
//! assert_eq!(trace.read(&solved)?.values.to_f64(), [0.0, 0.0, 1.0]);
//! # std::fs::remove_file(&path)?;
//! # Ok(())
//! # }
//! ```

mod column;
mod convert;
mod error;
mod layout;
mod precision;
mod reader;
mod recorder;
mod repair;
mod routes;
mod summary;

pub use convert::{Converted, Target, convert};
pub use error::TraceError;
pub use layout::Layout;
pub use precision::Precision;
pub use reader::{Entry, EntryType, TraceReader};
pub use recorder::{Recorder, Trial, is_npz};
pub use repair::{Repaired, repair};
pub use summary::{ColumnSummary, Summary, TrialSummary, summarise};
