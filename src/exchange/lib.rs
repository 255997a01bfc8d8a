//! Recordings of episodes as datasets of other programs.
//!
//! | what | where | loaded by |
//! |---|---|---|
//! | [`minari`] | HDF5 and JSON in `ID/data` | `minari.load_dataset(ID)` |
//! | [`lerobot`] | Parquet, JSON and MP4 in a folder, version 3.0 | `LeRobotDataset(ID, root=FOLDER)` |
//!
//! Both are written episode by episode. A Minari dataset is complete after every episode; a LeRobot dataset appears under its name
//! when it is finished, or with its first episode and is complete after every other ([`lerobot::LeRobotWriter::grow`]).

pub mod lerobot;
pub mod minari;

mod episode;
mod exported;
mod json;
mod progress;

pub use episode::Episode;
pub use exported::Exported;
pub use progress::{Progress, STOPPED};
