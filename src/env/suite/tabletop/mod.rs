//! Table-top manipulation: an arm with a gripper of two fingers, and things on a table.
//!
//! No task names a robot. Each finds the arm by the roles of its robot (`roles.toml` of its folder), and its registry rows name the
//! station, which is the arm at its table: `define = [["ROBOT", "panda"]]`. What follows is the same for all of them.
//!
//! Action: positions of the joints that the servos have, -1 to 1 for their ranges, and of the gripper. Observed: `joint_pos`, `joint_vel`;
//! `tool`, the tool centre point \[m\], and `tool_axes`, its z and y axes; `opening` of the gripper, 0 to 1; `holds`, whether the
//! condition of the task holds, and `held`, for how long it has \[s\]; and what the task adds. A step lasts 0.02 s. A task is solved when its condition has held for 0.5 s while the
//! arm touches nothing, which ends the episode. Terms of the reward: `reach`, `place` and others of the task \[m\], `held` while the
//! condition holds, `bonus` at the end, `penalty` where something was lost.

mod bench;
pub mod drawer;
pub mod insert;
mod place;
pub mod stack;
pub mod zip;

/// Time steps of the physics in one step of the environment: 0.02 s at the stations' 2 ms.
const FRAME_SKIP: usize = 10;
/// How long a condition is to hold \[s\].
const HOLD: f64 = 0.5;
/// Speed at which a thing is at rest \[m/s\].
const REST: f64 = 0.02;
