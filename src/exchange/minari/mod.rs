//! Minari's datasets: a folder `ID/data` with `main_data.hdf5`, a group an episode, and `metadata.json`.
//!
//! An episode of `n` steps has `observations` of `n + 1` rows, `actions`, `rewards`, `terminations` and `truncations` of
//! `n`, and `infos/…` of `n + 1`; observations and actions may be groups. Images are stored without loss.
//!
//! ```
//! use robohive_exchange::minari::DatasetId;
//!
//! let id = DatasetId::new("robohive/door/random-v0")?;
//! assert_eq!(id.folders().collect::<Vec<_>>(), ["robohive", "robohive/door"]);
//! let error = DatasetId::new("door").err().ok_or("no version")?;
//! assert!(error.to_string().contains("-v and a number"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod export;
mod id;
mod metadata;
mod writer;

pub use export::{Target, export};
pub use id::{DatasetId, DatasetIdError};
pub use metadata::{About, box_space, env_spec};
pub use writer::{Columns, MinariWriter};
