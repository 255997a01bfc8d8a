//! Our own models as text, with limits of their robots, for programs that carry them along. What each shows, and where its numbers come from, stands in
//! the README of its folder.
//!
//! ```
//! let (path, text) = robohive_assets::FILES[0];
//! assert_eq!(path, "delays/delays.xml");
//! assert!(text.contains("<mujoco"));
//! ```

macro_rules! files {
    ($($path:literal,)*) => { &[$(($path, include_str!($path)),)*] };
}

/// Every file by its path in this folder. Models include others by relative paths.
pub const FILES: &[(&str, &str)] = files![
    "delays/delays.xml",
    "drape/drape.xml",
    "elbow/elbow.xml",
    "franka/franka_table.xml",
    "franka/tasks/arm.toml",
    "franka/tasks/reach.xml",
    "grasp/grasp.xml",
    "humanoid/humanoid.xml",
    "pile/pile.xml",
    "quadruped/quadruped.xml",
    "quadruped/tasks/walk.xml",
    "servos/servos.xml",
    "workbench/workbench.xml",
    "yard/parts/crane.xml",
    "yard/yard.xml",
];
