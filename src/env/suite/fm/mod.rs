//! Arms with hands and grippers as they stand in laboratories.

mod data;
mod pose;
mod text_precision;

use super::Entry;

/// The tasks of this suite by name.
pub const TASKS: &[Entry] =
    &[("ee_pose", pose::build), ("robotiq_pose", pose::build_robotiq), ("robotiq_data", data::build)];
